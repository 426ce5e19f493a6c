// The curves found so far: whether a point lies on one of them, and its distance from them.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "curves/trace_curve.hpp"

namespace peterka::curves {

// A point's distance from a curve, in units of given sizes, and the curve's values at the nearest point.
struct Nearest {
    double distance = 0;
    double trace = 0;
    double total_speed = 0;
    std::array<std::int64_t, 2> impacts{};  // at both ends of the chord that it lies on
};
[[nodiscard]] Nearest nearest_on(const Curve& curve, const PlanePoint& place, const PlanePoint& sizes);

// Whether a curve is of this kind and passes through a point with the same orbit.
[[nodiscard]] bool lies_on(const Curve& curve, CurveKind kind, std::int64_t period, const CurvePoint& point,
                           const PlanePoint& window);

// How many of five points of a curve, spread over it, lie on another.
inline constexpr std::size_t points_of_curve = 5;
[[nodiscard]] int points_on(const Curve& curve, const Curve& other, const PlanePoint& window);

// Whether most of one of two curves lies on the other.
[[nodiscard]] bool is_same(const Curve& a, const Curve& b, const PlanePoint& window);

}  // namespace peterka::curves
