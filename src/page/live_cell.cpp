#include "page/live_cell.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

#include "regime/solve_cell.hpp"
#include "trace/impact_window.hpp"
#include "trace/sampler.hpp"

namespace peterka::page {

namespace {

using trajectory::Cycle;

// Reports this many cycles to a watcher, or those before one that cannot be followed.
template <class AfterCycle>
void pass(const trace::Carrier& carrier, const scene::State<double>& start, std::int64_t cycles,
          trace::Watcher& watcher, const AfterCycle& after_cycle) {
    regime::CycleMap map = regime::make_cycle_map(carrier.oscillator, carrier.settings);
    trajectory::Recorder<double> recorder(trajectory::Detail::contacts, watcher);
    scene::State<double> state = start;
    for (std::int64_t cycle = 0; cycle < cycles; ++cycle) {
        watcher.begin_cycle(carrier.oscillator.period() * static_cast<double>(cycle));
        const Cycle<double> passed =
            std::visit([&](auto& m) -> Cycle<double> { return m(state, &recorder); }, map);
        if (passed.outcome != Cycle<double>::Outcome::done) return;
        state = passed.end;
        after_cycle(passed);
    }
    watcher.finish(state, trajectory::phase_of(carrier.oscillator, state));
}

}  // namespace

Motion follow(const trace::Carrier& carrier, const scene::State<double>& start, std::int64_t cycles,
              std::int64_t samples_per_cycle) {
    Motion motion;
    const double length = carrier.oscillator.period() * static_cast<double>(cycles);
    trace::Sampler sampler(carrier.oscillator, length, samples_per_cycle);
    pass(carrier, start, cycles, sampler, [&](const Cycle<double>& cycle) {
        ++motion.cycles;
        motion.points.push_back(cycle.end);
        motion.jacobian = cycle.jacobian * motion.jacobian;
    });
    motion.instants = sampler.instants();
    trace::Impacts impacts(length);
    pass(carrier, start, cycles, impacts, [](const Cycle<double>&) {});
    motion.impacts = impacts.all();
    return motion;
}

std::vector<trace::Instant> look_closely(const trace::Carrier& carrier, const scene::State<double>& start,
                                         const Motion& motion, std::size_t impact, std::int64_t samples,
                                         double width) {
    constexpr double share_before = 1.0 / 3;
    const trace::Impact& seen = motion.impacts[impact];
    const double contact = seen.end - seen.time;
    trace::ImpactWindow window(
        carrier.oscillator,
        trace::plan_window(impact, seen.time, contact > 0 ? 3 * contact : width, share_before, samples,
                           carrier.oscillator.period() * static_cast<double>(motion.cycles)));
    pass(carrier, start, motion.cycles, window, [](const Cycle<double>&) {});
    return window.instants();
}

LiveCell::LiveCell(const job::Job& job, std::size_t points)
    : scene_(job),
      cell_(scene_.cell(0, 0)),
      motion_(std::max<std::size_t>(points, 1)),
      search_(regime::solve_cell(broker_, scene_.job(), cell_, {}, points > 0 ? &motion_ : nullptr)) {
    search_.start();
}

bool LiveCell::advance(std::int64_t cycles) {
    for (std::int64_t done = 0; done < cycles && !search_.done();) {
        done += static_cast<std::int64_t>(broker_.order().cycles);
        engine_.serve(broker_);
    }
    if (search_.done()) result_ = search_.result();
    return search_.done();
}

scene::State<double> LiveCell::steady_start() const {
    if (std::isfinite(result_.orbit_displacement)) {
        return {result_.orbit_displacement - carrier().oscillator.gap, result_.orbit_velocity};
    }
    return motion_.end.value_or(start());
}

}  // namespace peterka::page
