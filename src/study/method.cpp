#include "study/method.hpp"

#include <type_traits>

#include "trajectory/recorder.hpp"

namespace peterka::study {

namespace {

using integrators::Integrator;
using trajectory::Cycle;
using AnyMap = std::variant<trajectory::ExactCycleMap<double>, trajectory::SplitCycleMap<double>,
                            integrators::IntegratedCycleMap, Rk4CycleMap>;

AnyMap make_map(const Oscillator<double>& oscillator, const Run& run, double largest_displacement) {
    using integrators::IntegratedCycleMap;
    const auto integrated = [&](Integrator integrator) {
        return IntegratedCycleMap(oscillator, integrator, run.setting);
    };
    const auto fixed_step = [&](Rk4Events events) {
        return Rk4CycleMap(oscillator, static_cast<int>(run.setting), events);
    };
    switch (run.method) {
        case Method::split:
            return trajectory::SplitCycleMap<double>(
                oscillator, trajectory::split_steps(oscillator, largest_displacement, run.setting));
        case Method::cvode_adams:
            return integrated(Integrator::cvode_adams);
        case Method::cvode_bdf:
            return integrated(Integrator::cvode_bdf);
        case Method::arkode_explicit:
            return integrated(Integrator::arkode_explicit);
        case Method::arkode_implicit:
            return integrated(Integrator::arkode_implicit);
        case Method::rk4_with_events:
            return fixed_step(Rk4Events::located);
        case Method::rk4_without_events:
            return fixed_step(Rk4Events::ignored);
        case Method::exact:
        case Method::batched:
            break;
    }
    return trajectory::ExactCycleMap<double>(oscillator);
}

}  // namespace

std::vector<Run> runs(bool cubic, std::span<const double> tolerances,
                      std::span<const std::int64_t> steps_per_cycle) {
    std::vector<Run> runs;
    const auto add = [&](Method method, const auto& settings) {
        for (const auto setting : settings) runs.push_back({method, static_cast<double>(setting)});
    };
    runs.push_back({Method::exact, 0});
    if (!cubic) runs.push_back({Method::batched, 0});
    if (cubic) add(Method::split, tolerances);
    for (const Method method :
         {Method::cvode_adams, Method::cvode_bdf, Method::arkode_explicit, Method::arkode_implicit}) {
        add(method, tolerances);
    }
    add(Method::rk4_with_events, steps_per_cycle);
    add(Method::rk4_without_events, steps_per_cycle);
    return runs;
}

MethodMap::MethodMap(const Oscillator<double>& oscillator, const Run& run, double largest_displacement)
    : map_(make_map(oscillator, run, largest_displacement)) {}

bool MethodMap::advance(State<double>& x) {
    const auto one_cycle = [&](auto& map) -> Cycle<double> {
        if constexpr (std::is_same_v<std::decay_t<decltype(map)>, Rk4CycleMap>) {
            return static_cast<const Cycle<double>&>(map(x, false));  // the part that is compared
        } else {
            return map(x, nullptr);
        }
    };
    const Cycle<double> cycle = std::visit(one_cycle, map_);
    x = cycle.end;
    return cycle.outcome == Cycle<double>::Outcome::done;
}

Observation MethodMap::observe(const State<double>& x) {
    const auto observed = [](const Cycle<double>& cycle, double peak_force) {
        return Observation{cycle.outcome == Cycle<double>::Outcome::done, cycle.end, cycle.impacts, peak_force,
                           cycle.last_touch};
    };
    return std::visit(
        [&](auto& map) {
            if constexpr (std::is_same_v<std::decay_t<decltype(map)>, Rk4CycleMap>) {
                const auto cycle = map(x, true);
                return observed(cycle, cycle.peak_force);
            } else {
                trajectory::Recorder<double> recorder;
                const auto cycle = map(x, &recorder);
                return observed(cycle, recorder.totals().peak_force());
            }
        },
        map_);
}

}  // namespace peterka::study
