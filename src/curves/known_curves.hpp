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

// Whether a curve is of this kind and passes through a point with the same orbit.
[[nodiscard]] bool lies_on(const Curve& curve, CurveKind kind, std::int64_t period, const CurvePoint& point,
                           const PlanePoint& window);

// Whether a curve has already been found.
[[nodiscard]] bool is_known(const std::vector<Curve>& known, const Curve& curve, const PlanePoint& window);

}  // namespace peterka::curves
