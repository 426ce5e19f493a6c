// The curves found so far: whether a point lies on one of them, and its distance from them.
#pragma once

#include <vector>

#include "curves/trace_curve.hpp"

namespace peterka::curves {

// A point's distance from a curve, in units of given sizes, and the curve's values at the nearest point.
struct Nearest {
    double distance = 0;
    double trace = 0;
    double total_speed = 0;
};
[[nodiscard]] Nearest nearest_on(const Curve& curve, const PlanePoint& place, const PlanePoint& sizes);

struct CurveLabel {
    CurveKind kind = CurveKind::fold;
    std::int64_t impacts = 0;
    std::int64_t period = 0;
    // Of a grazing the impacts count with or without it, as either side is stable.
    [[nodiscard]] bool may_be(const CurveLabel& other) const {
        return kind == other.kind && period == other.period &&
               (kind == CurveKind::grazing || impacts == other.impacts);
    }
};
[[nodiscard]] inline CurveLabel label_of(const Seed& seed) {
    return {seed.kind, seed.point.orbit.impacts(), seed.point.orbit.period};
}
[[nodiscard]] inline CurveLabel label_of(const Curve& curve) {
    return {curve.kind, curve.impacts, curve.period};
}

// Whether a curve has this label and passes through a point with the same orbit.
[[nodiscard]] bool lies_on(const Curve& curve, const CurveLabel& label, const CurvePoint& point,
                           const PlanePoint& window);

// How many of five points of a curve, spread over it, lie on another.
inline constexpr std::size_t points_of_curve = 5;
[[nodiscard]] int points_on(const Curve& curve, const Curve& other, const PlanePoint& window);

// Whether most of one of two curves lies on the other.
[[nodiscard]] bool is_same(const Curve& a, const Curve& b, const PlanePoint& window);

}  // namespace peterka::curves
