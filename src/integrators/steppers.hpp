// CVODE and ARKODE behind one interface: a leg is started, advances step by step, and can be evaluated anywhere
// within the last step, at the integrator's own accuracy.
//
// Both are created once and re-initialized for each leg. The leg given to the constructor must outlive the
// stepper and not move. Errors: see integrators/objects.hpp.
#pragma once

#include "integrators/leg.hpp"
#include "integrators/objects.hpp"

namespace peterka::integrators {

// The progress of a leg.
class LegProgress {
  public:
    [[nodiscard]] const LegPoint& before() const { return before_; }  // start of the last step
    [[nodiscard]] const LegPoint& now() const { return now_; }

  protected:
    void begin(const State<double>& x, double length) {
        length_ = length;
        now_ = {0, x, Jacobian<double>::Identity()};
        before_ = now_;
    }
    double length_ = 0;
    LegPoint before_;
    LegPoint now_;
};

class CvodeStepper : public LegProgress {
  public:
    enum class Method { adams, bdf };
    CvodeStepper(SundialsLeg& leg, Method method);

    // Starts a leg of at most `length` with steps no longer than `longest_step`; the flow starts as the
    // identity.
    void start(const State<double>& x, double length, double longest_step);
    // One step. False if the integration failed.
    [[nodiscard]] bool step();
    // Within the last step, by the method's own polynomial. False if the integration failed.
    [[nodiscard]] bool look(double time, LegPoint& point);

  private:
    sundials_library::Context context_ = sundials_library::make_context();
    sundials_library::Vector unknowns_;
    sundials_library::DenseSolver dense_;
    sundials_library::NonlinearSolver functional_iteration_;  // Adams
    sundials_library::Memory solver_;
};

class ArkodeStepper : public LegProgress {
  public:
    enum class Method { explicit_5, explicit_8, implicit_5 };
    ArkodeStepper(SundialsLeg& leg, Method method);

    void start(const State<double>& x, double length, double longest_step);
    [[nodiscard]] bool step();
    // By a shorter step from the same start: as accurate as the step itself, stiff or not.
    [[nodiscard]] bool look(double time, LegPoint& point);

  private:
    sundials_library::Memory make_solver(SundialsLeg& leg, const sundials_library::DenseSolver& dense) const;
    void restart(void* solver, const LegPoint& from, double stop);
    [[nodiscard]] bool evolve(void* solver, double stop, int task, LegPoint& point);

    Method method_;
    sundials_library::Context context_ = sundials_library::make_context();
    sundials_library::Vector unknowns_;
    sundials_library::DenseSolver dense_;
    sundials_library::DenseSolver looking_dense_;
    sundials_library::Memory solver_;
    sundials_library::Memory looking_;  // integrates from the start of a step to a point within it
};

}  // namespace peterka::integrators
