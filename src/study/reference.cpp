#include "study/reference.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <limits>

#include "scene/in_precision.hpp"

namespace peterka::study {

namespace {

using scene::Jacobian;
using scene::Oscillator;
using scene::State;
using trajectory::ExactCycleMap;

std::variant<ExactCycleMap<Extended>, TaylorCycleMap> make_map(const Oscillator<double>& oscillator) {
    const auto extended = scene::in_precision<Extended>(oscillator);
    const bool linear = oscillator.cubic == 0 && oscillator.spring_dashpot() != nullptr;
    if (linear) return ExactCycleMap<Extended>(extended);
    return TaylorCycleMap(extended);
}

ReferenceCycle measured(const ExactCycleMap<Extended>& map, const State<Extended>& x) {
    trajectory::Recorder<Extended> recorder(trajectory::Detail::contacts);
    const auto cycle = map(x, &recorder);
    const auto& totals = recorder.totals();
    return {cycle, totals.peak_force(), totals.impact_speed, totals.largest_displacement};
}

// In double precision, by an engine that includes the cubic spring: accurate enough for Newton's method.
std::optional<Jacobian<Extended>> jacobian_of(const Oscillator<double>& oscillator, State<double> x,
                                              std::int64_t period) {
    regime::CycleMap map = regime::make_cycle_map(
        oscillator, {oscillator.cubic == 0 ? regime::Engine::exact : regime::Engine::arkode, 1e-10});
    Jacobian<double> jacobian = Jacobian<double>::Identity();
    for (std::int64_t n = 0; n < period; ++n) {
        const auto cycle = std::visit([&](auto& m) { return m(x, nullptr); }, map);
        if (cycle.outcome != trajectory::Cycle<double>::Outcome::done) return std::nullopt;
        x = cycle.end;
        jacobian = (cycle.jacobian * jacobian).eval();
    }
    return jacobian.cast<Extended>();
}

std::optional<ReferenceOrbit> follow(const Reference& reference, State<Extended> x, std::int64_t period) {
    ReferenceOrbit orbit;
    for (std::int64_t n = 0; n < period; ++n) {
        orbit.points.push_back(x);
        orbit.cycles.push_back(reference(x));
        if (orbit.cycles.back().outcome != ReferenceCycle::Outcome::done) return std::nullopt;
        x = orbit.cycles.back().end;
    }
    return orbit;
}

}  // namespace

Reference::Reference(const Oscillator<double>& oscillator) : map_(make_map(oscillator)) {}

ReferenceCycle Reference::operator()(const State<Extended>& x) const {
    if (const auto* exact = std::get_if<ExactCycleMap<Extended>>(&map_)) return measured(*exact, x);
    return std::get<TaylorCycleMap>(map_)(x);
}

std::int64_t ReferenceOrbit::impacts() const {
    std::int64_t impacts = 0;
    for (const ReferenceCycle& cycle : cycles) impacts += cycle.impacts;
    return impacts;
}

Extended ReferenceOrbit::peak_force() const {
    Extended peak = 0;
    for (const ReferenceCycle& cycle : cycles) peak = std::max(peak, cycle.peak_force);
    return peak;
}

Extended ReferenceOrbit::largest_displacement() const {
    Extended largest = 0;
    for (const ReferenceCycle& cycle : cycles) largest = std::max(largest, cycle.largest_displacement);
    return largest;
}

// Newton's method with a fixed Jacobian of lower precision: each step gains about ten digits.
std::optional<ReferenceOrbit> reference_orbit(const Oscillator<double>& oscillator, const State<double>& start,
                                              const job::SteadyState& budget) {
    constexpr int most_steps = 12;
    constexpr Extended close_enough = 1e-17L;
    const auto engine = oscillator.cubic == 0 ? regime::Engine::exact : regime::Engine::arkode;
    const auto settled = regime::find_steady_state(oscillator, start, budget, {engine, 1e-10});
    if (settled.regime != regime::Regime::periodic) return std::nullopt;
    const State<double> near(settled.orbit_displacement - oscillator.gap, settled.orbit_velocity);
    const auto jacobian = jacobian_of(oscillator, near, settled.period);
    if (!jacobian) return std::nullopt;
    const Jacobian<Extended> system = Jacobian<Extended>::Identity() - *jacobian;

    const Reference reference(oscillator);
    State<Extended> x = near.cast<Extended>();
    for (int step = 0; step < most_steps; ++step) {
        const auto orbit = follow(reference, x, settled.period);
        if (!orbit) return std::nullopt;
        const State<Extended> residual = orbit->cycles.back().end - x;
        if (residual.norm() < close_enough * (1 + x.norm()) || step + 1 == most_steps) {
            const bool same = orbit->impacts() == settled.impacts;
            return same && residual.norm() < 1e-14L * (1 + x.norm()) ? orbit : std::nullopt;
        }
        x += system.partialPivLu().solve(residual);
    }
    return std::nullopt;
}

}  // namespace peterka::study
