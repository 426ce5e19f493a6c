// The curves found so far: whether a point lies on one of them, and how far away they are.
#pragma once

#include <vector>

#include "curves/trace_curve.hpp"

namespace peterka::curves {

// Where a point lies next to a curve: in the plane, in shares of sizes given, and what the curve has there.
struct Nearest {
    double distance = 0;
    double trace = 0;
    double total_speed = 0;
};
[[nodiscard]] Nearest nearest_on(const Curve& curve, const PlanePoint& place, const PlanePoint& sizes);

// Whether a curve of this kind passes through a point with the same orbit.
[[nodiscard]] bool lies_on(const Curve& curve, CurveKind kind, std::int64_t period, const CurvePoint& point,
                           const PlanePoint& window);

// Whether a curve is one that is known already.
[[nodiscard]] bool is_known(const std::vector<Curve>& known, const Curve& curve, const PlanePoint& window);

}  // namespace peterka::curves
