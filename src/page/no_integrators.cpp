// Without SUNDIALS its engines are unavailable: each cycle that a search requests of them fails, so that the
// cell is `failed` and its `engine` shows why.
#include "integrators/integrated_cycle_map.hpp"

namespace peterka::integrators {

struct IntegratedCycleMap::Engine {
    Oscillator<double> oscillator;
};

IntegratedCycleMap::IntegratedCycleMap(const Oscillator<double>& oscillator, Integrator /*integrator*/,
                                       double /*relative_tolerance*/)
    : engine_(std::make_unique<Engine>(Engine{oscillator})) {}

IntegratedCycleMap::IntegratedCycleMap(IntegratedCycleMap&&) noexcept = default;
IntegratedCycleMap& IntegratedCycleMap::operator=(IntegratedCycleMap&&) noexcept = default;
IntegratedCycleMap::~IntegratedCycleMap() = default;

const Oscillator<double>& IntegratedCycleMap::oscillator() const {
    return engine_->oscillator;
}

// NOLINTNEXTLINE(readability-convert-member-functions-to-static): the interface of every engine
Cycle<double> IntegratedCycleMap::operator()(const State<double>& x, Recorder<double>* /*recorder*/) {
    Cycle<double> cycle;
    cycle.outcome = Cycle<double>::Outcome::solver_failed;
    cycle.end = x;
    return cycle;
}

Cycle<double> IntegratedCycleMap::part(const State<double>& x, double /*from*/, double /*to*/) {
    return (*this)(x);
}

}  // namespace peterka::integrators
