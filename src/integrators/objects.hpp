// Thin move-only owners of SUNDIALS objects, and the check of every call.
//
// Three outcomes of a call are distinguished: success; a failed integration (a step size that vanished, an
// iteration that diverged), which is data of a cell; and a broken call (bad arguments, no memory), which throws
// peterka::Failure with the call's name and the library's own name of the flag.
#pragma once

#include <nvector/nvector_serial.h>
#include <sundials/sundials_nonlinearsolver.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include <memory>
#include <type_traits>

#include "integrators/versions.hpp"

namespace peterka::integrators::sundials_library {

// Throws if a call failed. `word` returns the library's name of the flag.
void require(int flag, const char* call, char* (*word)(long int));

// Throws if a constructor of the library returned nothing.
void require_object(const void* object, const char* call);

// Flags from -1 to -19 mean that the integration failed, lower ones that the call was wrong.
constexpr bool is_failed_integration(int flag) {
    return flag < 0 && flag > -20;
}

struct Free {
    void operator()(N_Vector v) const { N_VDestroy(v); }
    void operator()(SUNMatrix m) const { SUNMatDestroy(m); }
    void operator()(SUNLinearSolver s) const { SUNLinSolFree(s); }
    void operator()(SUNNonlinearSolver s) const { SUNNonlinSolFree(s); }
};
using Vector = std::unique_ptr<std::remove_pointer_t<N_Vector>, Free>;
using Matrix = std::unique_ptr<std::remove_pointer_t<SUNMatrix>, Free>;
using LinearSolver = std::unique_ptr<std::remove_pointer_t<SUNLinearSolver>, Free>;
using NonlinearSolver = std::unique_ptr<std::remove_pointer_t<SUNNonlinearSolver>, Free>;

// The memory of an integrator, freed by the library's own function for it.
struct FreeMemory {
    void (*free)(void**) = nullptr;
    void operator()(void* memory) const { free(&memory); }
};
using Memory = std::unique_ptr<void, FreeMemory>;

// Shared by all objects of one stepper, which are destroyed before it.
struct FreeContext {
    void operator()(SUNContext context) const { SUNContext_Free(&context); }
};
using Context = std::unique_ptr<std::remove_pointer_t<SUNContext>, FreeContext>;
Context make_context();

Vector make_vector(sunindextype size, SUNContext context);

// A dense matrix and the direct solver that works on it.
struct DenseSolver {
    DenseSolver(N_Vector pattern, SUNContext context);
    Matrix matrix;
    LinearSolver solver;
};

}  // namespace peterka::integrators::sundials_library
