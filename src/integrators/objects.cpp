#include "integrators/objects.hpp"

#include <cstdlib>
#include <string>

#include "support/errors.hpp"

namespace peterka::integrators::sundials_library {

void require(int flag, const char* call, char* (*word)(long int)) {
    if (flag >= 0) return;
    const std::unique_ptr<char, decltype(&std::free)> name(word(flag), &std::free);
    throw Failure(ExitCode::internal, std::string("SUNDIALS call ") + call + " failed with " + name.get() +
                                          " (" + std::to_string(flag) + ")");
}

void require_object(const void* object, const char* call) {
    if (object == nullptr) {
        throw Failure(ExitCode::internal,
                      std::string("SUNDIALS call ") + call + " made nothing: out of memory");
    }
}

Context make_context() {
    SUNContext context = nullptr;
    if (create_context(&context) < 0 || context == nullptr)
        throw Failure(ExitCode::internal, "SUNDIALS call SUNContext_Create made nothing: out of memory");
    return Context(context);
}

Vector make_vector(sunindextype size, SUNContext context) {
    Vector vector(N_VNew_Serial(size, context));
    require_object(vector.get(), "N_VNew_Serial");
    N_VEnableFusedOps_Serial(vector.get(), SUNTRUE);  // six numbers: calls cost more than sums
    return vector;
}

DenseSolver::DenseSolver(N_Vector pattern, SUNContext context)
    : matrix(SUNDenseMatrix(N_VGetLength(pattern), N_VGetLength(pattern), context)),
      solver(SUNLinSol_Dense(pattern, matrix.get(), context)) {
    require_object(matrix.get(), "SUNDenseMatrix");
    require_object(solver.get(), "SUNLinSol_Dense");
}

}  // namespace peterka::integrators::sundials_library
