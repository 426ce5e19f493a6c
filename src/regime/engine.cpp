#include "regime/engine.hpp"

#include <algorithm>
#include <cmath>

#include "trajectory/contact_rates.hpp"

namespace peterka::regime {

namespace {

// An explicit method follows the fastest decay of a contact, at the rate 2 b (Kelvin-Voigt: 2 zeta + chi), with
// steps of about 1/(2 b). An implicit one is cheaper where this rate greatly exceeds the contact's own
// frequency, or where a contact that lasts for a whole cycle would take more steps than an implicit method ever
// does.
bool contact_is_stiff(const scene::Oscillator<double>& oscillator) {
    // an impact at about the cart's speed, for laws whose rates depend on it
    const double response = trajectory::response_length(oscillator);
    const scene::State<double> impact(trajectory::static_depth(oscillator, response + std::abs(oscillator.gap)),
                                      response * std::max(1.0, oscillator.frequency));
    const auto [damping, stiffness] = trajectory::linearized_contact(oscillator, impact);
    return 2 * damping > 20 * std::sqrt(stiffness) || 2 * damping * oscillator.period() > 1e4;
}

}  // namespace

integrators::Integrator integrator_of(const scene::Oscillator<double>& oscillator, Engine engine) {
    using integrators::Integrator;
    const bool stiff = contact_is_stiff(oscillator);
    if (engine == Engine::arkode) return stiff ? Integrator::arkode_implicit : Integrator::arkode_explicit;
    return stiff ? Integrator::cvode_bdf : Integrator::cvode_adams;
}

CycleMap make_cycle_map(const scene::Oscillator<double>& oscillator, const EngineSettings& settings) {
    const bool rigid = scene::is_rigid(oscillator.contact);
    switch (settings.engine) {
        case Engine::exact:
            break;
        case Engine::split: {
            const int steps =
                trajectory::split_steps(oscillator, settings.largest_displacement, settings.tolerance);
            if (rigid) return trajectory::RigidSplitMap<double>(oscillator, steps);
            return trajectory::SplitCycleMap<double>(oscillator, steps);
        }
        case Engine::cvode:
        case Engine::arkode:
            return integrators::IntegratedCycleMap(oscillator, integrator_of(oscillator, settings.engine),
                                                   settings.tolerance);
    }
    if (rigid) return trajectory::RigidExactMap<double>(oscillator);
    return trajectory::ExactCycleMap<double>(oscillator);
}

double effect_of_cubic(const scene::Oscillator<double>& oscillator, double largest_displacement) {
    const double reach = largest_displacement +
                         (oscillator.cubic_form == job::CubicForm::absolute ? oscillator.cart_reach() : 0);
    return 3 * std::abs(oscillator.cubic) * reach * reach;
}

bool has_nonlinear_contact(const scene::Oscillator<double>& oscillator) {
    return !scene::has_closed_form(oscillator.contact);
}

Engine cheaper_integrator(const scene::Oscillator<double>& oscillator) {
    return contact_is_stiff(oscillator) ? Engine::cvode : Engine::arkode;
}

namespace {

Engine fit_with_cubic(const scene::Oscillator<double>& oscillator, const job::Solver& solver,
                      double largest_displacement) {
    switch (solver.engine) {
        case job::EngineChoice::split:
            return Engine::split;
        case job::EngineChoice::cvode:
            return Engine::cvode;
        case job::EngineChoice::arkode:
            return Engine::arkode;
        case job::EngineChoice::exact:
            return Engine::exact;
        case job::EngineChoice::automatic:
            break;
    }
    const bool splits = !has_nonlinear_contact(oscillator) &&
                        trajectory::split_steps(oscillator, largest_displacement, solver.tolerance) > 0;
    return splits ? Engine::split : cheaper_integrator(oscillator);
}

}  // namespace

bool has_batch(const scene::Oscillator<double>& oscillator, Engine engine) {
    if (has_nonlinear_contact(oscillator)) return false;
    if (engine == Engine::exact) return true;
    const bool kicks =
        !scene::is_rigid(oscillator.contact) && oscillator.cubic_form == job::CubicForm::relative;
    return engine == Engine::split && (oscillator.cubic == 0 || kicks);
}

bool may_use_batch(const scene::Oscillator<double>& oscillator, const job::Solver& solver) {
    switch (solver.engine) {
        case job::EngineChoice::automatic:
            if (oscillator.cubic == 0 || solver.omit_tolerance > 0) return has_batch(oscillator, Engine::exact);
            return has_batch(oscillator, Engine::split);
        case job::EngineChoice::exact:
            return has_batch(oscillator, Engine::exact);
        case job::EngineChoice::split:
            return has_batch(oscillator, Engine::split);
        case job::EngineChoice::cvode:
        case job::EngineChoice::arkode:
            break;
    }
    return false;
}

void EngineByReach::choose(double largest_displacement) {
    settings_ = {fit_with_cubic(oscillator_, solver_, largest_displacement), solver_.tolerance,
                 largest_displacement};
    if (settings_.engine == Engine::split) settings_.tolerance = split_tolerance_;
}

bool EngineByReach::must_change(double reached) {
    constexpr int most_changes = 2;  // one suffices, unless the reach itself depends on the kicks
    if (changes_ == most_changes || !goes_too_far(oscillator_, settings_, reached)) return false;
    ++changes_;
    choose(reached);
    return true;
}

bool goes_too_far(const scene::Oscillator<double>& oscillator, const EngineSettings& chosen,
                  double displacement) {
    constexpr double slack = 1.1;  // the kicks' error grows with its fourth power at most: by half
    if (chosen.engine != Engine::split || !(displacement > slack * chosen.largest_displacement)) return false;
    const auto steps = [&](double reach) {
        return trajectory::split_steps(oscillator, reach, chosen.tolerance);
    };
    return steps(displacement) != steps(chosen.largest_displacement);
}

}  // namespace peterka::regime
