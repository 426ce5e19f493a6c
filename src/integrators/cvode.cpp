#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include "support/expect.hpp"

#include "integrators/steppers.hpp"

namespace peterka::integrators {

namespace {

void require_cvode(int flag, const char* call) {
    sundials_library::require(flag, call, CVodeGetReturnFlagName);
}

}  // namespace

CvodeStepper::CvodeStepper(SundialsLeg& leg, Method method)
    : unknowns_(sundials_library::make_vector(leg_unknowns, context_.get())),
      dense_(unknowns_.get(), context_.get()),
      solver_(CVodeCreate(method == Method::adams ? CV_ADAMS : CV_BDF, context_.get()), {CVodeFree}) {
    sundials_library::require_object(solver_.get(), "CVodeCreate");
    void* solver = solver_.get();
    require_cvode(sundials_library::silence_cvode(solver), "CVodeSetErrHandlerFn");
    store({}, unknowns_.get());
    require_cvode(CVodeInit(solver, leg_slope, 0, unknowns_.get()), "CVodeInit");
    require_cvode(CVodeSetUserData(solver, &leg), "CVodeSetUserData");
    require_cvode(CVodeWFtolerances(solver, leg_weights), "CVodeWFtolerances");
    require_cvode(CVodeSetMaxErrTestFails(solver, most_retries), "CVodeSetMaxErrTestFails");
    require_cvode(CVodeSetMaxConvFails(solver, most_retries), "CVodeSetMaxConvFails");
    if (method == Method::adams) {
        functional_iteration_.reset(SUNNonlinSol_FixedPoint(unknowns_.get(), 0, context_.get()));
        sundials_library::require_object(functional_iteration_.get(), "SUNNonlinSol_FixedPoint");
        require_cvode(CVodeSetNonlinearSolver(solver, functional_iteration_.get()), "CVodeSetNonlinearSolver");
    } else {
        require_cvode(CVodeSetLinearSolver(solver, dense_.solver.get(), dense_.matrix.get()),
                      "CVodeSetLinearSolver");
        require_cvode(CVodeSetJacFn(solver, leg_jacobian), "CVodeSetJacFn");
    }
}

void CvodeStepper::start(const State<double>& x, double length, double longest_step) {
    PETERKA_EXPECT(length > 0 && longest_step > 0 && x.allFinite());
    begin(x, length);
    store(now_, unknowns_.get());
    require_cvode(CVodeReInit(solver_.get(), 0, unknowns_.get()), "CVodeReInit");
    require_cvode(CVodeSetMaxStep(solver_.get(), longest_step), "CVodeSetMaxStep");
    require_cvode(CVodeSetStopTime(solver_.get(), length), "CVodeSetStopTime");
}

bool CvodeStepper::step() {
    before_ = now_;
    double time = 0;
    const int flag = CVode(solver_.get(), length_, unknowns_.get(), &time, CV_ONE_STEP);
    if (sundials_library::is_failed_integration(flag)) return false;
    require_cvode(flag, "CVode");
    now_ = load(unknowns_.get(), time);
    return true;
}

bool CvodeStepper::look(double time, LegPoint& point) {
    const int flag = CVodeGetDky(solver_.get(), time, 0, unknowns_.get());
    if (flag == CV_BAD_T) return false;  // in a step so short that rounding moves its ends
    require_cvode(flag, "CVodeGetDky");
    point = load(unknowns_.get(), time);
    return true;
}

}  // namespace peterka::integrators
