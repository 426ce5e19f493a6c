// The run command: from a job file to a finished map file and its summary, on all ranks.
#pragma once

#include "parallel/session.hpp"
#include "run/run_plan.hpp"
#include "support/errors.hpp"

namespace peterka {

// Collective. Returns done, too_many_failures or stopped_early; throws Failure.
[[nodiscard]] ExitCode run_job(const parallel::Session& session, const RunPlan& plan);

}  // namespace peterka
