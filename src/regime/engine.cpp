#include "regime/engine.hpp"

#include <cmath>

namespace peterka::regime {

namespace {

// An explicit method follows the fastest decay of a contact, at the rate 2 b = 2 zeta + chi, with steps of
// about 1/(2 b). An implicit one is cheaper where that is much faster than the contact's own frequency, or
// where a contact that lasts for a whole cycle would take more steps than an implicit method ever does.
bool contact_is_stiff(const scene::Oscillator<double>& scene) {
    const auto* stop = std::get_if<scene::KelvinVoigt<double>>(&scene.contact);
    if (stop == nullptr) return false;
    const double rate = 2 * scene.damping_ratio + stop->damping;
    return rate > 20 * std::sqrt(1 + stop->stiffness) || rate * scene.period() > 1e4;
}

}  // namespace

CycleMap make_cycle_map(const scene::Oscillator<double>& scene, const EngineSettings& settings) {
    using trajectory::IntegratedCycleMap;
    using trajectory::Integrator;
    const bool stiff = contact_is_stiff(scene);
    const bool rigid = std::holds_alternative<scene::Restitution<double>>(scene.contact);
    const auto& [engine, tolerance, largest_displacement] = settings;
    switch (engine) {
        case Engine::exact:
            break;
        case Engine::split: {
            const int steps = trajectory::split_steps(scene, largest_displacement, tolerance);
            if (rigid) return trajectory::RigidSplitMap<double>(scene, steps);
            return trajectory::SplitCycleMap<double>(scene, steps);
        }
        case Engine::cvode:
            return IntegratedCycleMap(scene, stiff ? Integrator::cvode_bdf : Integrator::cvode_adams,
                                      tolerance);
        case Engine::arkode:
            return IntegratedCycleMap(scene, stiff ? Integrator::arkode_implicit : Integrator::arkode_explicit,
                                      tolerance);
    }
    if (rigid) return trajectory::RigidExactMap<double>(scene);
    return trajectory::ExactCycleMap<double>(scene);
}

double effect_of_cubic(const scene::Oscillator<double>& scene, double largest_displacement) {
    const double reach = largest_displacement + (scene.cubic_form == job::CubicForm::absolute ? 1 : 0);
    return 3 * std::abs(scene.cubic) * reach * reach;
}

Engine engine_with_cubic(const scene::Oscillator<double>& scene, const job::Solver& solver,
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
    return trajectory::split_steps(scene, largest_displacement, solver.tolerance) > 0 ? Engine::split
                                                                                      : Engine::cvode;
}

}  // namespace peterka::regime
