#include "regime/known_orbit.hpp"

#include <utility>

namespace peterka::regime {

namespace {

// In scaled coordinates. The convergence test decides; this only spares it distant orbits.
constexpr double far_off = 1;

}  // namespace

std::optional<PeriodicOrbit> KnownOrbit::seen_from(const Point& state) const {
    const std::size_t q = points_.size();
    std::size_t first = q;
    double least = far_off;
    for (std::size_t n = 0; n < q; ++n) {
        const double distance = (points_[n] - state).lpNorm<Eigen::Infinity>();
        if (!(distance < least)) continue;
        least = distance;
        first = n;
    }
    if (first == q) return std::nullopt;
    PeriodicOrbit orbit;
    orbit.jacobian = Eigen::Matrix2d::Identity();
    for (std::size_t n = 0; n < q; ++n) {
        const std::size_t place = (first + n) % q;
        orbit.points.push_back(points_[place]);
        orbit.jacobian = (cycles_[place].jacobian * orbit.jacobian).eval();
        orbit.pattern = append(orbit.pattern, cycles_[place].pattern);
    }
    orbit.multiplier = spectral_radius(orbit.jacobian);
    orbit.touched = true;
    return orbit;
}

Task<std::optional<KnownOrbit>> follow_known_orbit(StroboscopicMap& map, Point point, std::int64_t q) {
    auto orbit = co_await find_orbit(map, point, q);
    if (!orbit || !is_stable(*orbit) || has_smaller_period(*orbit)) co_return std::nullopt;
    std::vector<CycleResult> cycles;
    for (const Point& from : orbit->points) {
        cycles.push_back(co_await map.cycle(from));
        if (!cycles.back().ok) co_return std::nullopt;
    }
    co_return KnownOrbit(std::move(orbit->points), std::move(cycles));
}

}  // namespace peterka::regime
