// Which engine carries a cell from cycle to cycle, chosen by a fixed rule.
#pragma once

#include <variant>

#include "integrators/integrated_cycle_map.hpp"
#include "job/job.hpp"
#include "regime/cell_result.hpp"
#include "scene/oscillator.hpp"
#include "trajectory/exact_cycle_map.hpp"
#include "trajectory/split_cycle_map.hpp"

namespace peterka::regime {

// The maps in closed form once for each law that has them.
using CycleMap = std::variant<trajectory::ExactCycleMap<double>, trajectory::RigidExactMap<double>,
                              trajectory::SplitCycleMap<double>, trajectory::RigidSplitMap<double>,
                              trajectory::IntegratedCycleMap>;

struct EngineSettings {
    Engine engine = Engine::exact;
    double tolerance = 1e-9;           // relative error asked for in peak force; `exact` has none
    double largest_displacement = 10;  // of |u|: what the number of kicks of `split` is chosen for
    double orbit_tolerance = 1;        // the same of an orbit once it is found, where that is less
};

// The method that stands for an engine that integrates: implicit where the contact is stiff.
trajectory::Integrator integrator_of(const scene::Oscillator<double>& scene, Engine engine);

CycleMap make_cycle_map(const scene::Oscillator<double>& scene, const EngineSettings& settings);

// Largest relative change of the springs' stiffness by the cubic term at a displacement u, 3 cubic u^2: what
// leaving the term out may change in peak force, away from bifurcations. (absolute form: at |x| <= |u| + 1)
double effect_of_cubic(const scene::Oscillator<double>& scene, double largest_displacement);

// Whether the stop's own motion is nonlinear, so that only integrators carry it.
bool has_nonlinear_contact(const scene::Oscillator<double>& scene);

// On cells of each law, at tolerances of 1e-6 and 1e-9, arkode's explicit methods took half the time of cvode's
// Adams; in stiff contacts cvode's BDF is cheaper than arkode's implicit method.
Engine cheaper_integrator(const scene::Oscillator<double>& scene);

// The engine that keeps the cubic term: what the job names, or the cheapest that is fit for its strength.
EngineSettings engine_with_cubic(const scene::Oscillator<double>& scene, const job::Solver& solver,
                                 double largest_displacement);

// Whether a motion went further than its engine was chosen for: the kicks of `split` hang on that.
bool goes_too_far(const scene::Oscillator<double>& scene, const EngineSettings& chosen, double displacement);

}  // namespace peterka::regime
