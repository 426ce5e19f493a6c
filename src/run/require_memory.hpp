// Refuses, before anything is created, a job for which memory is insufficient, counted over all ranks of a
// machine.
#pragma once

#include <mpi.h>

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "job/job.hpp"
#include "parallel/session.hpp"
#include "run/memory_left.hpp"
#include "run/run_plan.hpp"

namespace peterka {

// A machine whose ranks need more than is left [bytes].
struct Lack {
    std::int64_t needed_by_each = 0;
    std::int64_t ranks = 1;  // that need it together: all on the machine, or one with a limit of its own
    MemoryLeft left = {};
    std::array<char, 64> host = {};  // its name, truncated
};

// Collective. The lack on the first machine that has one, on all ranks. left_to_all: memory left to the ranks
// of this rank's machine.
[[nodiscard]] std::optional<Lack> lack_of_memory(const job::Job& job, MPI_Comm communicator,
                                                 const MemoryLeft& left_to_all);

// For one rank on this machine. Throws Failure(ExitCode::bad_job), naming what is needed, what is left and why.
// Kinds of jobs that need little always pass. where: the job.
void require_memory(const std::string& where, const job::Job& job);

// Collective. For the ranks of each machine together; rank 0 reports which machine lacks memory.
void require_memory(const parallel::Session& session, const RunPlan& plan);

}  // namespace peterka
