// `check`, and `run` for each kind of job.
#pragma once

#include <string>

#include "parallel/session.hpp"
#include "run/command_line.hpp"
#include "run/run_plan.hpp"
#include "support/errors.hpp"

namespace peterka {

// What a job means and what it costs, without computing anything: the resolved job with a header of comments,
// which tell cells, tiles, memory and file size. It is itself a job file that reads back as the same job.
// Throws JobFaults.
[[nodiscard]] std::string check_job(const Request& request);

// From a job to a finished file and its summary. Collective; these return done, too_many_failures (run_job) or
// stopped_early, and throw Failure.
[[nodiscard]] ExitCode run_job(const parallel::Session& session, const RunPlan& plan);  // map, basin, sweep
[[nodiscard]] ExitCode run_curves(const parallel::Session& session, const RunPlan& plan);
[[nodiscard]] ExitCode run_study(const parallel::Session& session, const RunPlan& plan);
// One cell in time, by rank 0 alone. If a stop is requested it throws Failure with the code stopped_early.
[[nodiscard]] ExitCode run_trace(const parallel::Session& session, const RunPlan& plan);

}  // namespace peterka
