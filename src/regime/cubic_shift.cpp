#include "regime/cubic_shift.hpp"

#include <cmath>

#include "regime/periodic_orbit.hpp"
#include "regime/stroboscopic_map.hpp"
#include "trajectory/recorder.hpp"

namespace peterka::regime {

Task<CubicShift> shift_by_cubic(CycleDesk& desk, scene::Oscillator<double> scene, EngineSettings engine,
                                CellResult without) {
    StroboscopicMap map(scene, engine, desk);
    const scene::State<double> start(without.orbit_displacement - scene.gap, without.orbit_velocity);
    const auto orbit = co_await find_orbit(map, map.scaled(start), without.period);
    if (!orbit || !is_stable(*orbit) || has_smaller_period(*orbit)) co_return {{}, map.cycles_spent()};

    Recorder<double> recorder;
    for (const Point& point : orbit->points) {
        const Passage cycle = co_await map.cycle(point, &recorder);
        if (!cycle.ok) co_return {{}, map.cycles_spent()};
    }
    const auto& totals = recorder.totals();
    const double change = std::abs(totals.peak_force() / without.peak_force - 1);
    const bool alike = totals.impacts == without.impacts && std::isfinite(change) &&
                       !goes_too_far(engine, totals.displacement_bound);
    co_return {alike ? std::optional(change) : std::nullopt, map.cycles_spent()};
}

}  // namespace peterka::regime
