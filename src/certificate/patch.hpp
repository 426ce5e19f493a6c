// Sets of places of one event, carried along a leg to the next event.
//
// A set is {m + F r : r in R} with a point m, a point matrix F and a box R. For a place x of the set the leg's
// equations G(x, y) = 0 have exactly one solution y in a box Y, if y0 - G_y^-1 G(X, y0) lies within Y, where
// G_y is enclosed for all x in X and y in Y (interval Newton with a parameter; A. Neumaier, Interval Methods
// for Systems of Equations, Cambridge 1990, section 5.1). Its derivative is dy/dx = -G_y^-1 G_x, and the next
// set is the mean value form around y(m), with F close to a rotation (R. J. Lohner, in Computer Arithmetic,
// Teubner 1987).
#pragma once

#include <optional>

#include "certificate/event_chain.hpp"

namespace peterka::certificate {

struct Patch {
    Event event;  // its kind, and m
    Matrix<Interval> frame;
    Vector<Interval> spread;  // R

    [[nodiscard]] Place<Interval> hull() const;
};

// Columns of a rotation: the first along the longer of two directions, the columns times R's sizes.
[[nodiscard]] Matrix<Interval> frame_along(const Matrix<Interval>& directions, const Vector<Interval>& spread);

// A set that consists of an enclosed place alone.
[[nodiscard]] Patch patch_of(EventKind kind, const Place<Interval>& place);

struct Passage {
    Patch end;
    Matrix<Interval> derivative;  // of the end's (time, along) by the beginning's
};

// To the next event, for which `to` is a guess; to.cycle counts from the cycle of `from`. nothing: it is not
// proved that all places of the set lead to an event of this kind, transversally, and meet no other before.
[[nodiscard]] std::optional<Passage> pass(const Springs<Interval>& springs, const Springs<double>& approximate,
                                          const Patch& from, const Event& to);

// The same from a state at time 0.
[[nodiscard]] std::optional<Patch> pass_from_start(const Springs<Interval>& springs, bool presses,
                                                   const Vector<Interval>& state, const Event& to);

}  // namespace peterka::certificate
