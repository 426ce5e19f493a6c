#include "regime/engine.hpp"

#include <algorithm>
#include <cmath>

#include "trajectory/contact_rates.hpp"

namespace peterka::regime {

namespace {

// An explicit method follows the fastest decay of a contact, at the rate 2 b (Kelvin-Voigt: 2 zeta + chi), with
// steps of about 1/(2 b). An implicit one is cheaper where that is much faster than the contact's own
// frequency, or where a contact that lasts for a whole cycle would take more steps than an implicit method ever
// does.
bool contact_is_stiff(const scene::Oscillator<double>& scene) {
    // an impact at the cart's speed or so, for laws whose rates depend on it
    const double response = trajectory::response_length(scene);
    const scene::State<double> impact(trajectory::static_depth(scene, response + std::abs(scene.gap)),
                                      response * std::max(1.0, scene.frequency));
    const auto [damping, stiffness] = trajectory::linearized_contact(scene, impact);
    return 2 * damping > 20 * std::sqrt(stiffness) || 2 * damping * scene.period() > 1e4;
}

}  // namespace

trajectory::Integrator integrator_of(const scene::Oscillator<double>& scene, Engine engine) {
    using trajectory::Integrator;
    const bool stiff = contact_is_stiff(scene);
    if (engine == Engine::arkode) return stiff ? Integrator::arkode_implicit : Integrator::arkode_explicit;
    return stiff ? Integrator::cvode_bdf : Integrator::cvode_adams;
}

CycleMap make_cycle_map(const scene::Oscillator<double>& scene, const EngineSettings& settings) {
    const bool rigid = scene::is_rigid(scene.contact);
    switch (settings.engine) {
        case Engine::exact:
            break;
        case Engine::split: {
            const int steps = trajectory::split_steps(scene, settings.largest_displacement, settings.tolerance);
            if (rigid) return trajectory::RigidSplitMap<double>(scene, steps);
            return trajectory::SplitCycleMap<double>(scene, steps);
        }
        case Engine::cvode:
        case Engine::arkode:
            return trajectory::IntegratedCycleMap(scene, integrator_of(scene, settings.engine),
                                                  settings.tolerance);
    }
    if (rigid) return trajectory::RigidExactMap<double>(scene);
    return trajectory::ExactCycleMap<double>(scene);
}

double effect_of_cubic(const scene::Oscillator<double>& scene, double largest_displacement) {
    const double reach =
        largest_displacement + (scene.cubic_form == job::CubicForm::absolute ? scene.cart_reach() : 0);
    return 3 * std::abs(scene.cubic) * reach * reach;
}

bool has_nonlinear_contact(const scene::Oscillator<double>& scene) {
    return !scene::has_closed_form(scene.contact);
}

Engine cheaper_integrator(const scene::Oscillator<double>& scene) {
    return contact_is_stiff(scene) ? Engine::cvode : Engine::arkode;
}

namespace {

Engine fit_with_cubic(const scene::Oscillator<double>& scene, const job::Solver& solver,
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
    const bool splits = !has_nonlinear_contact(scene) &&
                        trajectory::split_steps(scene, largest_displacement, solver.tolerance) > 0;
    return splits ? Engine::split : cheaper_integrator(scene);
}

}  // namespace

bool has_batch(const scene::Oscillator<double>& scene, Engine engine) {
    if (scene.spring_dashpot() == nullptr) return false;
    const bool relative = scene.cubic == 0 || scene.cubic_form == job::CubicForm::relative;
    return engine == Engine::exact || (engine == Engine::split && relative);
}

bool may_use_batch(const scene::Oscillator<double>& scene, const job::Solver& solver) {
    switch (solver.engine) {
        case job::EngineChoice::automatic:
            if (scene.cubic == 0 || solver.omit_tolerance > 0) return has_batch(scene, Engine::exact);
            return has_batch(scene, Engine::split);
        case job::EngineChoice::exact:
            return has_batch(scene, Engine::exact);
        case job::EngineChoice::split:
            return has_batch(scene, Engine::split);
        case job::EngineChoice::cvode:
        case job::EngineChoice::arkode:
            break;
    }
    return false;
}

void EngineByReach::choose(double largest_displacement) {
    settings_ = {fit_with_cubic(scene_, solver_, largest_displacement), solver_.tolerance,
                 largest_displacement};
    if (settings_.engine == Engine::split) settings_.tolerance = split_tolerance_;
}

bool EngineByReach::must_change(double reached) {
    constexpr int most_changes = 2;  // one does, unless the reach itself depends on the kicks
    if (changes_ == most_changes || !goes_too_far(scene_, settings_, reached)) return false;
    ++changes_;
    choose(reached);
    return true;
}

bool goes_too_far(const scene::Oscillator<double>& scene, const EngineSettings& chosen, double displacement) {
    constexpr double slack =
        1.1;  // the kicks' error goes with the fourth power of it at most: half as much again
    if (chosen.engine != Engine::split || !(displacement > slack * chosen.largest_displacement)) return false;
    const auto steps = [&](double reach) { return trajectory::split_steps(scene, reach, chosen.tolerance); };
    return steps(displacement) != steps(chosen.largest_displacement);
}

}  // namespace peterka::regime
