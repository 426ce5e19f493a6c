// Where the ranks run.
#pragma once

#include <string>

#include "parallel/session.hpp"

namespace peterka::parallel {

// Collective. On rank 0, the names of all machines, each once, in the order of their first ranks: "node1,
// node2"; on the other ranks "".
[[nodiscard]] std::string host_names(const Session& session);

// Collective. The number of ranks that run on this rank's machine.
[[nodiscard]] int ranks_of_host(MPI_Comm communicator);

}  // namespace peterka::parallel
