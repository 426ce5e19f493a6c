// Refuses, before anything is made, a job that memory can't hold: what counts is that of all ranks of a
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

// Of a machine whose ranks need more than is left [bytes].
struct Lack {
    std::int64_t needed_by_each = 0;
    std::int64_t ranks = 1;  // that need it together: all there, or one that is limited by itself
    MemoryLeft left = {};
    std::array<char, 64> host = {};  // its name, cut off
};

// Collective. Of the first machine that lacks memory, on all ranks. left_to_all: to the ranks of this one's
// machine.
[[nodiscard]] std::optional<Lack> lack_of_memory(const job::Job& job, MPI_Comm communicator,
                                                 const MemoryLeft& left_to_all);

// For one rank on this machine. Throws Failure(ExitCode::bad_job), naming what is needed, what is left and why.
// Kinds of jobs that take little are let through. where: the job.
void require_memory(const std::string& where, const job::Job& job);

// Collective. For the ranks of each machine together; rank 0 says which machine lacks memory.
void require_memory(const parallel::Session& session, const RunPlan& plan);

}  // namespace peterka
