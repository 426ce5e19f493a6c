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
                              integrators::IntegratedCycleMap>;

struct EngineSettings {
    Engine engine = Engine::exact;
    double tolerance = 1e-9;           // relative error asked for in peak force; `exact` has none
    double largest_displacement = 10;  // of |u|: what the number of kicks of `split` is chosen for
    double orbit_tolerance = 1;        // the same of an orbit once it is found, where that is less
};

// The method that stands for an engine that integrates: implicit where the contact is stiff.
integrators::Integrator integrator_of(const scene::Oscillator<double>& oscillator, Engine engine);

CycleMap make_cycle_map(const scene::Oscillator<double>& oscillator, const EngineSettings& settings);

// Largest relative change of the springs' stiffness by the cubic term at a displacement u, 3 cubic u^2: what
// leaving the term out may change in peak force, away from bifurcations. (absolute form: at |x| <= |u| + 1)
double effect_of_cubic(const scene::Oscillator<double>& oscillator, double largest_displacement);

// Whether the stop's own motion is nonlinear, so that only integrators carry it.
bool has_nonlinear_contact(const scene::Oscillator<double>& oscillator);

// On cells of each law, at tolerances of 1e-6 and 1e-9, arkode's explicit methods took half the time of cvode's
// Adams; in stiff contacts cvode's BDF is cheaper than arkode's implicit method.
Engine cheaper_integrator(const scene::Oscillator<double>& oscillator);

// Whether the batched kernel carries an oscillator with this engine: a spring-dashpot stop or a rigid one in
// closed form, and the first with the relative cubic as kicks.
bool has_batch(const scene::Oscillator<double>& oscillator, Engine engine);
// Whether cells of a job with this solver may be carried by it.
bool may_use_batch(const scene::Oscillator<double>& oscillator, const job::Solver& solver);

// The engine that keeps every term of an oscillator, for a motion whose reach shows only once it has been
// followed: the kicks of `split` depend on that. What the job names, or the cheapest that is fit for the
// cubic's strength.
//     do follow(engine.settings()); while (engine.must_change(reach));
class EngineByReach {
  public:
    // largest_displacement: of |u|, as far as is known.
    EngineByReach(const scene::Oscillator<double>& oscillator, const job::Solver& solver,
                  double largest_displacement)
        : oscillator_(oscillator), solver_(solver), split_tolerance_(solver.tolerance) {
        choose(largest_displacement);
    }
    // The same with another tolerance for `split`.
    EngineByReach(const scene::Oscillator<double>& oscillator, const job::Solver& solver,
                  double largest_displacement, double split_tolerance)
        : oscillator_(oscillator), solver_(solver), split_tolerance_(split_tolerance) {
        choose(largest_displacement);
    }

    [[nodiscard]] const EngineSettings& settings() const { return settings_; }
    // Whether the motion is to be followed again, by other settings, as it went further than assumed. Not for
    // ever.
    [[nodiscard]] bool must_change(double reached);

  private:
    void choose(double largest_displacement);

    scene::Oscillator<double> oscillator_;
    job::Solver solver_;
    double split_tolerance_;
    EngineSettings settings_;
    int changes_ = 0;
};

// Whether a motion went further than its engine was chosen for.
bool goes_too_far(const scene::Oscillator<double>& oscillator, const EngineSettings& chosen,
                  double displacement);

}  // namespace peterka::regime
