#include "regime/cubic_shift.hpp"

#include <algorithm>
#include <cmath>

#include "regime/orbit_round.hpp"
#include "regime/periodic_orbit.hpp"
#include "regime/stroboscopic_map.hpp"
#include "trajectory/recorder.hpp"

namespace peterka::regime {

Task<CubicShift> shift_by_cubic(CycleBroker& broker, scene::Oscillator<double> oscillator,
                                EngineSettings engine, CellResult without) {
    constexpr double converging = 0.1;  // largest second step, relative to the first
    StroboscopicMap map(oscillator, engine, broker);
    const auto q = static_cast<std::size_t>(without.period);
    PeriodicOrbit orbit;
    orbit.points = {
        map.scaled(scene::State<double>(without.orbit_displacement - oscillator.gap, without.orbit_velocity))};

    OrbitRound first(without.period);
    for (std::size_t n = 0; n < q; ++n) {
        const CycleResult cycle = co_await map.cycle(orbit.points[n]);
        if (!cycle.ok) co_return {{}, map.cycles_spent()};
        if (n + 1 < q) orbit.points.push_back(cycle.end);
        first.add(cycle, orbit.points[(n + 1) % q]);
    }
    const auto step = first.correct(orbit.points);
    if (!step) co_return {{}, map.cycles_spent()};

    const bool knows_speed = std::isfinite(without.impact_speed);
    Recorder<double> recorder(knows_speed ? trajectory::Detail::impacts : trajectory::Detail::force);
    OrbitRound second(without.period);
    for (std::size_t n = 0; n < q; ++n) {
        const CycleResult cycle = co_await map.cycle(orbit.points[n], &recorder);
        if (!cycle.ok) co_return {{}, map.cycles_spent()};
        second.add(cycle, orbit.points[(n + 1) % q]);
    }
    orbit.multiplier = spectral_radius(second.jacobian());
    const bool collapses = has_smaller_period(orbit);
    const auto rest = second.correct(orbit.points);
    const auto& totals = recorder.totals();
    const bool alike = rest && *rest <= converging * *step && is_stable(orbit) && !collapses &&
                       first.pattern() == second.pattern() && totals.impacts == without.impacts &&
                       !goes_too_far(oscillator, engine, totals.displacement_bound);
    if (!alike) co_return {{}, map.cycles_spent()};
    const double of_speed = knows_speed ? std::abs(totals.impact_speed / without.impact_speed - 1) : 0;
    const double change = totals.struck_rigid_stop ? std::max(*step, of_speed)
                                                   : std::abs(totals.peak_force() / without.peak_force - 1);
    if (!std::isfinite(change)) co_return {{}, map.cycles_spent()};
    const double open = *step > 0 ? *rest / *step : 0;
    co_return {change * (1 + 2 * open), map.cycles_spent()};
}

}  // namespace peterka::regime
