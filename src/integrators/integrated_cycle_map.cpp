#include "integrators/integrated_cycle_map.hpp"

#include <string>
#include <variant>

#include "integrators/cycle.hpp"
#include "support/errors.hpp"

namespace peterka::integrators {

namespace {

using Cvode = CycleIntegration<CvodeStepper>;
using Arkode = CycleIntegration<ArkodeStepper>;

// Local errors accumulate over a cycle and grow towards the peak force. With these shares of the requested
// tolerance the periodic orbits of the header meet it; smaller ones would only cost time.
constexpr double adams_share = 0.0025;
constexpr double bdf_share = 5e-4;
constexpr double explicit_5_share = 0.4;
constexpr double explicit_8_share = 5;  // its steps are short for other reasons: more accurate than requested
constexpr double implicit_share = 0.004;

constexpr double tight = 2e-8;  // below it the explicit method of order 8 is faster than the one of order 5

// The error estimate of Fehlberg's order-8 method (NASA TR R-287, 1968) sees only the ends of a step: it misses
// the effect of a nonsmooth force at first touch.
bool suits_order_8(const Oscillator<double>& oscillator) {
    return scene::has_smooth_force(oscillator.contact);
}

}  // namespace

struct IntegratedCycleMap::Engine {
    std::variant<Cvode, Arkode> integration;

    Engine(const Oscillator<double>& oscillator, Integrator integrator, double tolerance)
        : integration(make(oscillator, integrator, tolerance)) {}

    static std::variant<Cvode, Arkode> make(const Oscillator<double>& oscillator, Integrator integrator,
                                            double tolerance) {
        switch (integrator) {
            case Integrator::cvode_adams:
                return Cvode(oscillator, CvodeStepper::Method::adams, adams_share * tolerance);
            case Integrator::cvode_bdf:
                return Cvode(oscillator, CvodeStepper::Method::bdf, bdf_share * tolerance);
            case Integrator::arkode_explicit:
                if (tolerance < tight && suits_order_8(oscillator)) {
                    return Arkode(oscillator, ArkodeStepper::Method::explicit_8, explicit_8_share * tolerance);
                }
                return Arkode(oscillator, ArkodeStepper::Method::explicit_5, explicit_5_share * tolerance);
            case Integrator::arkode_implicit:
                break;
        }
        return Arkode(oscillator, ArkodeStepper::Method::implicit_5, implicit_share * tolerance);
    }
};

IntegratedCycleMap::IntegratedCycleMap(const Oscillator<double>& oscillator, Integrator integrator,
                                       double relative_tolerance) {
    if (!(relative_tolerance >= 1e-12 && relative_tolerance <= 0.1)) {
        throw Failure(ExitCode::internal,
                      "relative tolerance of an integrator = " + std::to_string(relative_tolerance) +
                          " must be from 1e-12 to 0.1");
    }
    engine_ = std::make_unique<Engine>(oscillator, integrator, relative_tolerance);
}

IntegratedCycleMap::IntegratedCycleMap(IntegratedCycleMap&&) noexcept = default;
IntegratedCycleMap& IntegratedCycleMap::operator=(IntegratedCycleMap&&) noexcept = default;
IntegratedCycleMap::~IntegratedCycleMap() = default;

const Oscillator<double>& IntegratedCycleMap::oscillator() const {
    return std::visit([](const auto& i) -> const Oscillator<double>& { return i.oscillator(); },
                      engine_->integration);
}

Cycle<double> IntegratedCycleMap::operator()(const State<double>& x, Recorder<double>* recorder) {
    return std::visit([&](auto& i) { return i.cycle(x, 0, i.oscillator().period(), recorder); },
                      engine_->integration);
}

Cycle<double> IntegratedCycleMap::part(const State<double>& x, double from, double to) {
    return std::visit([&](auto& i) { return i.cycle(x, from, to, nullptr); }, engine_->integration);
}

}  // namespace peterka::integrators
