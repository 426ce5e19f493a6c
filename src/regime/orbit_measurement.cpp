#include "regime/orbit_measurement.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

namespace peterka::regime {

Task<MeasuredOrbit> measure_orbit(StroboscopicMap& map, PeriodicOrbit& orbit, Observation& observation) {
    constexpr int most_rounds = 6;
    constexpr double at_rest = 1e-13;  // relative move that changes no reported digit
    const std::size_t q = orbit.points.size();
    bool was_open = false;
    for (int n = 0;; ++n) {
        observation.begin_again();
        OrbitRound round(orbit.period());
        for (std::size_t point = 0; point < q; ++point) {
            const CycleResult cycle = co_await map.cycle(orbit.points[point], &observation.recorder());
            if (!cycle.ok) co_return MeasuredOrbit{round, cycle.outcome};
            round.add(cycle, orbit.points[(point + 1) % q]);
            observation.end_cycle();
        }
        const bool opens = observation.is_open() && !was_open;
        was_open = observation.is_open();
        orbit.jacobian = round.jacobian();
        orbit.multiplier = spectral_radius(orbit.jacobian);
        Points moved = orbit.points;
        const double last = orbit.error;
        orbit.error = round.correct(moved).value_or(1);
        const bool rests = orbit.error < std::max(at_rest, map.noise()) || orbit.error > last / 2;
        if ((rests && !opens) || n == most_rounds) co_return MeasuredOrbit{round};
        if (!rests) orbit.points = std::move(moved);
    }
}

// The remaining Newton correction, amplified within a cycle, is an error of an impact's speed, which the force
// of a spring and dashpot follows.
double force_error(const StroboscopicMap& map, const PeriodicOrbit& orbit, const OrbitRound& round,
                   double force) {
    const auto* stop = map.oscillator().spring_dashpot();
    if (stop == nullptr || map.noise() > 0) return 0;
    double largest = 0;
    for (const Point& point : orbit.points) {
        largest = std::max(largest, map.unscaled(Point(Point::Constant(magnitude(point)))).maxCoeff());
    }
    const double speed_error = orbit.error * round.largest_stretch() * largest;
    return speed_error * std::max(stop->damping, std::sqrt(stop->stiffness)) / force;
}

}  // namespace peterka::regime
