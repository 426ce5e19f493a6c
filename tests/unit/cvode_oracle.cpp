#include "cvode_oracle.hpp"

#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>

namespace peterka::testing {

namespace {

enum class Phase { flight, contact, unloaded };

struct Equation {
    scene::Oscillator<double> scene;
    Phase phase = Phase::flight;

    [[nodiscard]] double force(const double* x) const {
        return scene.contact_stiffness * x[0] + scene.contact_damping * x[1];
    }
};

int right_hand_side(double t, N_Vector x, N_Vector slope, void* data) {
    const auto& [scene, phase] = *static_cast<Equation*>(data);
    const double* s = N_VGetArrayPointer(x);
    const double force =
        phase == Phase::contact ? scene.contact_stiffness * s[0] + scene.contact_damping * s[1] : 0;
    double* d = N_VGetArrayPointer(slope);
    d[0] = s[1];
    d[1] = scene.drive() * std::sin(scene.frequency * t) - 2 * scene.damping_ratio * s[1] - s[0] - scene.gap -
           force;
    return 0;
}

int events(double /*t*/, N_Vector x, double* value, void* data) {
    const auto& equation = *static_cast<Equation*>(data);
    const double* s = N_VGetArrayPointer(x);
    value[0] = s[0];
    value[1] = equation.force(s) / (equation.scene.contact_stiffness + equation.scene.contact_damping);
    return 0;
}

void require(int flag, const char* call) {
    if (flag < 0) throw std::runtime_error(std::string(call) + " failed with " + std::to_string(flag));
}

template <class T, void (*destroy)(T)>
struct Destroy {
    using pointer = T;
    void operator()(T object) const { destroy(object); }
};
void free_solver(void* memory) {
    CVodeFree(&memory);
}
void free_matrix(SUNMatrix matrix) {
    SUNMatDestroy(matrix);
}
void free_linear_solver(SUNLinearSolver solver) {
    SUNLinSolFree(solver);
}

}  // namespace

IntegratedCycle integrate_cycle(const scene::Oscillator<double>& scene, const scene::State<double>& start) {
    const sundials::Context context;
    const std::unique_ptr<N_Vector, Destroy<N_Vector, N_VDestroy>> x(N_VNew_Serial(2, context));
    const std::unique_ptr<SUNMatrix, Destroy<SUNMatrix, free_matrix>> matrix(SUNDenseMatrix(2, 2, context));
    const std::unique_ptr<SUNLinearSolver, Destroy<SUNLinearSolver, free_linear_solver>> linear_solver(
        SUNLinSol_Dense(x.get(), matrix.get(), context));
    const std::unique_ptr<void*, Destroy<void*, free_solver>> cvode(CVodeCreate(CV_BDF, context));
    double* state = N_VGetArrayPointer(x.get());
    state[0] = start[0];
    state[1] = start[1];

    Equation equation{scene, start[0] < 0 || (start[0] == 0 && start[1] <= 0)        ? Phase::flight
                             : Equation{scene, {}}.force(state) > 0 || start[0] == 0 ? Phase::contact
                                                                                     : Phase::unloaded};
    require(CVodeInit(cvode.get(), right_hand_side, 0, x.get()), "CVodeInit");
    require(CVodeSStolerances(cvode.get(), 1e-11, 1e-13), "CVodeSStolerances");
    require(CVodeSetLinearSolver(cvode.get(), linear_solver.get(), matrix.get()), "CVodeSetLinearSolver");
    require(CVodeSetUserData(cvode.get(), &equation), "CVodeSetUserData");
    require(CVodeRootInit(cvode.get(), 2, events), "CVodeRootInit");
    require(CVodeSetMaxNumSteps(cvode.get(), 1'000'000), "CVodeSetMaxNumSteps");
    require(CVodeSetNoInactiveRootWarn(cvode.get()), "CVodeSetNoInactiveRootWarn");

    const double period = scene.period();
    IntegratedCycle cycle;
    double t = 0;
    while (t < period) {
        // the returned state lies a hair past a root: only crossings in the phase's own direction count
        int directions[2] = {equation.phase == Phase::flight ? 1 : -1,
                             equation.phase == Phase::contact ? -1 : 1};
        require(CVodeSetRootDirection(cvode.get(), directions), "CVodeSetRootDirection");
        require(CVodeSetMaxStep(cvode.get(), equation.phase == Phase::contact ? 1e-3 : 1e-2),
                "CVodeSetMaxStep");
        require(CVodeSetStopTime(cvode.get(), period), "CVodeSetStopTime");
        const int flag = CVode(cvode.get(), period, x.get(), &t, CV_NORMAL);
        require(flag, "CVode");
        if (flag != CV_ROOT_RETURN) break;
        int found[2] = {0, 0};
        require(CVodeGetRootInfo(cvode.get(), found), "CVodeGetRootInfo");
        if (equation.phase == Phase::flight && found[0] != 0) {
            ++cycle.impacts;
            equation.phase = Phase::contact;
        } else if (equation.phase == Phase::contact && found[1] != 0) {
            equation.phase = state[0] > 0 ? Phase::unloaded : Phase::flight;
        } else if (equation.phase == Phase::unloaded) {
            equation.phase = found[0] != 0 ? Phase::flight : Phase::contact;
        }
        require(CVodeReInit(cvode.get(), t, x.get()), "CVodeReInit");
    }
    cycle.end = {state[0], state[1]};
    return cycle;
}

}  // namespace peterka::testing
