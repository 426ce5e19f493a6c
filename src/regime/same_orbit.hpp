// When two points, or two orbits, count as one. One tolerance for all who ask.
#pragma once

#include <algorithm>
#include <cmath>

namespace peterka::regime {

// Relative: orbits that coexist lie much farther apart, and the points of one are known much better.
inline constexpr double same_point = 1e-6;
// An orbit with a weak cubic spring and the same one without it, which different engines carry, differ by a
// little more than the change in force that is allowed. Of 64 starts in each of 4096 cells of the paper's
// plane, with its spring and with four times as much, the same orbits differ by up to 4e-3, but for seven of
// periods 12 to 33 in windows of chaos, while the nearest two that coexist with one label are 5.7e-3 apart.
inline constexpr double same_point_with_and_without = 5e-3;

// Whether two coordinates of points are the same.
[[nodiscard]] inline bool coincide(double a, double b, double tolerance = same_point) {
    return std::abs(a - b) <= tolerance * (1 + std::max(std::abs(a), std::abs(b)));
}

// Whether two cells that have an orbit have the same one. As solved or as stored.
template <class Cell>
[[nodiscard]] bool same_orbit(const Cell& a, const Cell& b) {
    const double tolerance = a.engine == b.engine ? same_point : same_point_with_and_without;
    return a.regime == b.regime && a.period == b.period && a.impacts == b.impacts &&
           coincide(a.orbit_displacement, b.orbit_displacement, tolerance) &&
           coincide(a.orbit_velocity, b.orbit_velocity, tolerance);
}

}  // namespace peterka::regime
