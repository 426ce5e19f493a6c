// The run command for a trace: one cell in time, by rank 0 alone, into a file of its own.
#pragma once

#include "parallel/session.hpp"
#include "run/run_plan.hpp"
#include "support/errors.hpp"

namespace peterka {

// Collective. Returns done; throws Failure, with the code stopped_early if a stop is requested.
[[nodiscard]] ExitCode run_trace(const parallel::Session& session, const RunPlan& plan);

}  // namespace peterka
