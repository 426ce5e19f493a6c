// The run command for curves: from a job file to the file of its curves and their summary, on all ranks.
#pragma once

#include "parallel/session.hpp"
#include "run/run_plan.hpp"
#include "support/errors.hpp"

namespace peterka {

// Collective. Returns done or stopped_early; throws Failure.
[[nodiscard]] ExitCode run_curves(const parallel::Session& session, const RunPlan& plan);

}  // namespace peterka
