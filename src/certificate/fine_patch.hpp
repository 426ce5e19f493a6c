// Sets of places that are carried along legs as patch.hpp's, with a middle m of many digits: they may be
// smaller than the distance of neighbouring doubles, so that a motion whose differences grow by 1e300 is still
// proved.
//
// That all places lead to one event, which and how, and the derivative there, is proved in doubles, of a patch
// that contains the set. The middle's own end is then enclosed in balls (ball.hpp), and the set's end is the
// mean value form around it, as in patch.hpp. The box R may be smaller than any double: it is kept over a power
// of two.
#pragma once

#include <optional>

#include "certificate/ball.hpp"
#include "certificate/patch.hpp"

namespace peterka::certificate {

struct FinePatch {
    EventKind kind = EventKind::touch;
    Place<Ball> middle;  // m, exact
    Matrix<Interval> frame;
    Vector<Interval> spread;  // R over 2^exponent; contains 0
    slong exponent = 0;

    // A patch of doubles that contains it.
    [[nodiscard]] Patch coarse() const;
};

[[nodiscard]] FinePatch fine_patch_of(const Patch& patch);

// The same springs in intervals, in balls, and approximately.
struct SpringsOf {
    const Springs<Interval>* enclosed;
    const Springs<double>* approximate;
    const Springs<Ball>* fine;
};

// As pass() and pass_from_start() of patch.hpp.
[[nodiscard]] std::optional<FinePatch> pass(const SpringsOf& springs, const FinePatch& from, const Event& to);
[[nodiscard]] std::optional<FinePatch> pass_from_start(const SpringsOf& springs, bool presses,
                                                       const Vector<Ball>& state, const Event& to);

}  // namespace peterka::certificate
