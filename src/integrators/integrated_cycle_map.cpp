#include "integrators/integrated_cycle_map.hpp"

#include <algorithm>
#include <cmath>
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

// Local errors of a ringing contact's flow grow to this many times its rate in the Jacobian, which decides on
// stability; a stop so stiff that no tolerance keeps them small isn't followed.
constexpr double of_jacobian = 0.01;
constexpr double tightest = 1e-14;

// The damped frequency of a contact into which the motion leads at its usual speed; 0 where it doesn't ring.
// [omega]
double rate_of_ringing(const Oscillator<double>& oscillator) {
    if (scene::is_rigid(oscillator.contact)) return 0;
    const double speed = trajectory::response_length(oscillator) * std::max(1.0, oscillator.frequency);
    const auto contact = trajectory::linearized_contact(oscillator, {0, speed});
    return std::sqrt(std::max(contact.stiffness - contact.damping * contact.damping, 0.0));
}

constexpr double tight = 2e-8;  // below it the explicit method of order 8 is faster than the one of order 5

// The error estimate of Fehlberg's order-8 method (NASA TR R-287, 1968) sees only the ends of a step: it misses
// the effect of a nonsmooth force at first touch.
bool suits_order_8(const Oscillator<double>& oscillator) {
    return scene::has_smooth_force(oscillator.contact);
}

}  // namespace

struct IntegratedCycleMap::Engine {
    double rate;
    std::variant<Cvode, Arkode> integration;

    Engine(const Oscillator<double>& oscillator, Integrator integrator, double tolerance)
        : rate(rate_of_ringing(oscillator)), integration(make(oscillator, integrator, tolerance, rate)) {}

    static std::variant<Cvode, Arkode> make(const Oscillator<double>& oscillator, Integrator integrator,
                                            double tolerance, double rate) {
        const double most = std::max(of_jacobian / std::max(rate, of_jacobian), tightest);
        const auto local = [&](double share) { return std::min(share * tolerance, most); };
        switch (integrator) {
            case Integrator::cvode_adams:
                return Cvode(oscillator, CvodeStepper::Method::adams, local(adams_share));
            case Integrator::cvode_bdf:
                return Cvode(oscillator, CvodeStepper::Method::bdf, local(bdf_share));
            case Integrator::arkode_explicit:
                if (tolerance < tight && suits_order_8(oscillator)) {
                    return Arkode(oscillator, ArkodeStepper::Method::explicit_8, local(explicit_8_share));
                }
                return Arkode(oscillator, ArkodeStepper::Method::explicit_5, local(explicit_5_share));
            case Integrator::arkode_implicit:
                break;
        }
        return Arkode(oscillator, ArkodeStepper::Method::implicit_5, local(implicit_share));
    }
    // A cycle with contacts so stiff that errors of rounding would decide on stability has failed.
    [[nodiscard]] Cycle<double> checked(Cycle<double> cycle) const {
        const bool is_too_stiff = rate * tightest > of_jacobian;
        if (cycle.touched && is_too_stiff) cycle.outcome = Cycle<double>::Outcome::solver_failed;
        return cycle;
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
    return engine_->checked(std::visit(
        [&](auto& i) { return i.cycle(x, 0, i.oscillator().period(), recorder); }, engine_->integration));
}

Cycle<double> IntegratedCycleMap::part(const State<double>& x, double from, double to) {
    return engine_->checked(
        std::visit([&](auto& i) { return i.cycle(x, from, to, nullptr); }, engine_->integration));
}

}  // namespace peterka::integrators
