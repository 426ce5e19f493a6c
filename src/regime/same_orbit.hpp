// When two points, or two orbits, count as one. One tolerance for all callers.
#pragma once

#include <algorithm>
#include <cmath>

namespace peterka::regime {

// Relative: coexisting orbits lie much farther apart, and the points of one are known much better.
inline constexpr double same_point = 1e-6;
// An orbit with a weak cubic spring and the same orbit without it, computed by different engines, differ by a
// little more than the allowed change in force. Of 64 starts in each of 4096 cells of the paper's plane, with
// its spring and with one four times as strong, the same orbits differ by up to 4e-3, except for seven of
// periods 12 to 33 in windows of chaos, while the nearest two coexisting orbits with one label are 5.7e-3
// apart.
inline constexpr double same_point_with_and_without = 5e-3;

// Whether two coordinates of points are the same.
[[nodiscard]] inline bool coincide(double a, double b, double tolerance = same_point) {
    return std::abs(a - b) <= tolerance * (1 + std::max(std::abs(a), std::abs(b)));
}

// Whether two cells with an orbit have the same one, as solved or as stored.
template <class Cell>
[[nodiscard]] bool same_orbit(const Cell& a, const Cell& b) {
    const double tolerance = a.engine == b.engine ? same_point : same_point_with_and_without;
    return a.regime == b.regime && a.period == b.period && a.impacts == b.impacts &&
           coincide(a.orbit_displacement, b.orbit_displacement, tolerance) &&
           coincide(a.orbit_velocity, b.orbit_velocity, tolerance);
}

}  // namespace peterka::regime
