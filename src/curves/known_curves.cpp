#include "curves/known_curves.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace peterka::curves {

Nearest nearest_on(const Curve& curve, const PlanePoint& place, const PlanePoint& sizes) {
    Nearest nearest{std::numeric_limits<double>::infinity()};
    for (std::size_t i = 0; i + 1 < curve.points.size(); ++i) {
        const CurvePoint& a = curve.points[i];
        const CurvePoint& b = curve.points[i + 1];
        const double ax = (a.place.column - place.column) / sizes.column;
        const double ay = (a.place.row - place.row) / sizes.row;
        const double dx = (b.place.column - a.place.column) / sizes.column;
        const double dy = (b.place.row - a.place.row) / sizes.row;
        const double length2 = dx * dx + dy * dy;
        const double share = length2 > 0 ? std::clamp(-(ax * dx + ay * dy) / length2, 0.0, 1.0) : 0;
        const double distance = std::hypot(ax + share * dx, ay + share * dy);
        if (distance >= nearest.distance) continue;
        nearest = {distance,
                   a.trace + share * (b.trace - a.trace),
                   a.total_speed + share * (b.total_speed - a.total_speed),
                   {a.impacts, b.impacts}};
    }
    return nearest;
}

bool lies_on(const Curve& curve, CurveKind kind, std::int64_t period, const CurvePoint& point,
             const PlanePoint& window) {
    constexpr double chord = 1e-3;  // largest deviation of a curve from its chords, in shares of the window
    constexpr double alike = 0.03;
    if (curve.kind != kind || curve.period != period) return false;
    const Nearest nearest = nearest_on(curve, point.place, window);
    return nearest.distance < chord && std::ranges::count(nearest.impacts, point.impacts) > 0 &&
           std::abs(nearest.trace - point.trace) < alike * (1 + std::abs(point.trace)) &&
           std::abs(nearest.total_speed - point.total_speed) < alike * (1e-3 + point.total_speed);
}

int points_on(const Curve& curve, const Curve& other, const PlanePoint& window) {
    int on = 0;
    for (std::size_t n = 1; n <= points_of_curve; ++n) {
        const CurvePoint& point = curve.points[n * curve.points.size() / (points_of_curve + 1)];
        on += lies_on(other, curve.kind, curve.period, point, window) ? 1 : 0;
    }
    return on;
}

// Not by one point: where trace or speed change fast, a point isn't recognized.
bool is_same(const Curve& a, const Curve& b, const PlanePoint& window) {
    const int most = std::max(points_on(a, b, window), points_on(b, a, window));
    return 2 * most > static_cast<int>(points_of_curve);
}

}  // namespace peterka::curves
