// The engine that carries a cell from cycle to cycle, chosen by a fixed rule.
#pragma once

#include <variant>

#include "integrators/integrated_cycle_map.hpp"
#include "job/job.hpp"
#include "regime/cell_result.hpp"
#include "scene/oscillator.hpp"
#include "trajectory/exact_cycle_map.hpp"
#include "trajectory/split_cycle_map.hpp"

namespace peterka::regime {

// The closed-form maps appear once for each law that has them.
using CycleMap = std::variant<trajectory::ExactCycleMap<double>, trajectory::RigidExactMap<double>,
                              trajectory::SplitCycleMap<double>, trajectory::RigidSplitMap<double>,
                              integrators::IntegratedCycleMap>;

struct EngineSettings {
    Engine engine = Engine::exact;
    double tolerance = 1e-9;           // requested relative error of the peak force; `exact` has none
    double largest_displacement = 10;  // of |u|, for which the number of kicks of `split` is chosen
    double orbit_tolerance = 1;        // tolerance for an orbit once it is found, if smaller
};

constexpr double finest_of_integrators = 1e-12;  // tolerance

// The integrator of the engine cvode or arkode: implicit where the contact is stiff.
integrators::Integrator integrator_of(const scene::Oscillator<double>& oscillator, Engine engine);

CycleMap make_cycle_map(const scene::Oscillator<double>& oscillator, const EngineSettings& settings);

// Largest relative change of the springs' stiffness by the cubic term at a displacement u, 3 cubic u^2: how
// much omitting the term may change the peak force, away from bifurcations. (absolute form: at |x| <= |u| + 1)
double effect_of_cubic(const scene::Oscillator<double>& oscillator, double largest_displacement);

// Whether the motion in contact is nonlinear, so that only integrators can compute it.
bool has_nonlinear_contact(const scene::Oscillator<double>& oscillator);

// In tests on cells of each law, at tolerances of 1e-6 and 1e-9, arkode's explicit methods took half the time
// of cvode's Adams; in stiff contacts cvode's BDF is cheaper than arkode's implicit method.
Engine cheaper_integrator(const scene::Oscillator<double>& oscillator);

// Whether the batched kernel carries an oscillator with this engine: a spring-dashpot or rigid stop in closed
// form, and the former with the relative cubic term as kicks.
bool has_batch(const scene::Oscillator<double>& oscillator, Engine engine);
// Whether the batched kernel may carry cells of a job with this solver.
bool may_use_batch(const scene::Oscillator<double>& oscillator, const job::Solver& solver);

// The engine that keeps every term of an oscillator, for a motion whose reach is known only once it has been
// followed: the kicks of `split` depend on the reach. Named by the job, or the cheapest that suits the cubic's
// strength.
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
    // Whether the motion must be followed again with other settings, as it went further than assumed. True only
    // a few times.
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
