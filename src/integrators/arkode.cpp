#include <cmath>

#include "support/expect.hpp"

#include "integrators/steppers.hpp"

namespace peterka::integrators {

namespace {

void require_arkode(int flag, const char* call) {
    sundials_library::require(flag, call, ARKodeGetReturnFlagName);
}

void* create(ArkodeStepper::Method method, N_Vector unknowns, SUNContext context) {
    const bool implicit = method == ArkodeStepper::Method::implicit_5;
    return ARKStepCreate(implicit ? nullptr : leg_slope, implicit ? leg_slope : nullptr, 0, unknowns, context);
}

}  // namespace

ArkodeStepper::ArkodeStepper(SundialsLeg& leg, Method method)
    : method_(method),
      unknowns_(sundials_library::make_vector(leg_unknowns, context_.get())),
      dense_(unknowns_.get(), context_.get()),
      looking_dense_(unknowns_.get(), context_.get()) {
    store({}, unknowns_.get());
    solver_ = make_solver(leg, dense_);
    looking_ = make_solver(leg, looking_dense_);
}

sundials_library::Memory ArkodeStepper::make_solver(SundialsLeg& leg,
                                                    const sundials_library::DenseSolver& dense) const {
    sundials_library::Memory owner(create(method_, unknowns_.get(), context_.get()), {ARKodeFree});
    void* solver = owner.get();
    sundials_library::require_object(solver, "ARKStepCreate");
    require_arkode(sundials_library::silence_arkode(solver), "ARKStepSetErrHandlerFn");
    require_arkode(ARKodeSetUserData(solver, &leg), "ARKodeSetUserData");
    require_arkode(ARKodeWFtolerances(solver, leg_weights), "ARKodeWFtolerances");
    require_arkode(ARKodeSetMaxErrTestFails(solver, most_retries), "ARKodeSetMaxErrTestFails");
    require_arkode(ARKodeSetMaxConvFails(solver, most_retries), "ARKodeSetMaxConvFails");
    if (method_ == Method::implicit_5) {
        require_arkode(ARKStepSetTableNum(solver, ARKODE_ARK548L2SA_DIRK_8_4_5, ARKODE_ERK_NONE),
                       "ARKStepSetTableNum");
        require_arkode(ARKodeSetLinearSolver(solver, dense.solver.get(), dense.matrix.get()),
                       "ARKodeSetLinearSolver");
        require_arkode(ARKodeSetJacFn(solver, leg_jacobian), "ARKodeSetJacFn");
        require_arkode(ARKodeSetLSetupFrequency(solver, 1), "ARKodeSetLSetupFrequency");
        require_arkode(ARKodeSetJacEvalFrequency(solver, 1), "ARKodeSetJacEvalFrequency");
    } else {
        const auto table = method_ == Method::explicit_8 ? ARKODE_FEHLBERG_13_7_8 : ARKODE_DORMAND_PRINCE_7_4_5;
        require_arkode(ARKStepSetTableNum(solver, ARKODE_DIRK_NONE, table), "ARKStepSetTableNum");
    }
    return owner;
}

void ArkodeStepper::restart(void* solver, const LegPoint& from, double stop) {
    const bool implicit = method_ == Method::implicit_5;
    store(from, unknowns_.get());
    require_arkode(ARKStepReInit(solver, implicit ? nullptr : leg_slope, implicit ? leg_slope : nullptr,
                                 from.time, unknowns_.get()),
                   "ARKStepReInit");
    require_arkode(ARKodeSetStopTime(solver, stop), "ARKodeSetStopTime");
}

bool ArkodeStepper::evolve(void* solver, double stop, int task, LegPoint& point) {
    double time = 0;
    const int flag = ARKodeEvolve(solver, stop, unknowns_.get(), &time, task);
    if (sundials_library::is_failed_integration(flag)) return false;
    require_arkode(flag, "ARKodeEvolve");
    point = load(unknowns_.get(), time);
    return true;
}

void ArkodeStepper::start(const State<double>& x, double length, double longest_step) {
    PETERKA_EXPECT(length > 0 && longest_step > 0 && x.allFinite());
    begin(x, length);
    restart(solver_.get(), now_, length);
    require_arkode(ARKodeSetMaxStep(solver_.get(), longest_step), "ARKodeSetMaxStep");
}

bool ArkodeStepper::step() {
    before_ = now_;
    return evolve(solver_.get(), length_, ARK_ONE_STEP, now_);
}

bool ArkodeStepper::look(double time, LegPoint& point) {
    constexpr double resolved = 1e-14;  // of local time: a shorter step would be lost in rounding
    const double step = time - before_.time;
    if (step <= resolved * time) {
        point = before_;
        return true;
    }
    restart(looking_.get(), before_, time);
    require_arkode(ARKodeSetInitStep(looking_.get(), step), "ARKodeSetInitStep");
    return evolve(looking_.get(), time, ARK_NORMAL, point);
}

}  // namespace peterka::integrators
