// MPI calls that cannot fail silently: any code other than MPI_SUCCESS becomes a Failure with the call's name
// and MPI's own text. Requires MPI_ERRORS_RETURN on the communicator, which Session sets.
#pragma once

#include <mpi.h>

#include <string_view>

namespace peterka::parallel {

// checked("MPI_Bcast", MPI_Bcast(...))
void checked(std::string_view call, int code);

}  // namespace peterka::parallel
