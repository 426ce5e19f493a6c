// Names that differ between releases of SUNDIALS, as in the newest: 6.4 to 6.7 (Debian 12), 7.0, and from 7.1
// on (Debian 13). No other code depends on the release.
#pragma once

#include <arkode/arkode_arkstep.h>
#include <cvode/cvode.h>
#include <sundials/sundials_config.h>
#include <sundials/sundials_context.h>

namespace peterka::integrators::sundials_library {

#if SUNDIALS_VERSION_MAJOR < 7

inline int create_context(SUNContext* context) {
    return SUNContext_Create(nullptr, context);
}
// The library prints no errors; flags report them. Each solver has a handler of its own.
inline void print_nothing(int, const char*, const char*, char*, void*) {}
inline int silence_cvode(void* solver) {
    return CVodeSetErrHandlerFn(solver, print_nothing, nullptr);
}
inline int silence_arkode(void* solver) {
    return ARKStepSetErrHandlerFn(solver, print_nothing, nullptr);
}

#else

// The context holds the error handlers of all solvers made with it.
inline int create_context(SUNContext* context) {
    const int flag = SUNContext_Create(SUN_COMM_NULL, context);
    return flag < 0 ? flag : SUNContext_ClearErrHandlers(*context);
}
inline int silence_cvode(void* /*solver*/) {
    return 0;
}
inline int silence_arkode(void* /*solver*/) {
    return 0;
}

#endif

}  // namespace peterka::integrators::sundials_library

// Before 7.1 each method of ARKODE had calls of its own.
#if SUNDIALS_VERSION_MAJOR < 7 || (SUNDIALS_VERSION_MAJOR == 7 && SUNDIALS_VERSION_MINOR < 1)

namespace peterka::integrators {

inline constexpr auto ARKodeFree = ARKStepFree;
inline constexpr auto ARKodeGetReturnFlagName = ARKStepGetReturnFlagName;
inline constexpr auto ARKodeSetUserData = ARKStepSetUserData;
inline constexpr auto ARKodeWFtolerances = ARKStepWFtolerances;
inline constexpr auto ARKodeSetMaxErrTestFails = ARKStepSetMaxErrTestFails;
inline constexpr auto ARKodeSetMaxConvFails = ARKStepSetMaxConvFails;
inline constexpr auto ARKodeSetLinearSolver = ARKStepSetLinearSolver;
inline constexpr auto ARKodeSetJacFn = ARKStepSetJacFn;
inline constexpr auto ARKodeSetLSetupFrequency = ARKStepSetLSetupFrequency;
inline constexpr auto ARKodeSetJacEvalFrequency = ARKStepSetJacEvalFrequency;
inline constexpr auto ARKodeSetStopTime = ARKStepSetStopTime;
inline constexpr auto ARKodeSetMaxStep = ARKStepSetMaxStep;
inline constexpr auto ARKodeSetInitStep = ARKStepSetInitStep;
inline constexpr auto ARKodeEvolve = ARKStepEvolve;

}  // namespace peterka::integrators

#endif
