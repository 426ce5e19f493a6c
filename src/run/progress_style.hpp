// Which rank shows progress, and how: rank 0 only, as a bar on a terminal.
#pragma once

#include "parallel/session.hpp"
#include "run/run_plan.hpp"
#include "support/progress.hpp"
#include "support/terminal.hpp"

namespace peterka {

inline ProgressStyle progress_style(const parallel::Session& session, const RunPlan& plan) {
    if (!session.is_root() || plan.quiet) return ProgressStyle::silent;
    return Terminal::of_stderr() ? ProgressStyle::bar : ProgressStyle::lines;
}

}  // namespace peterka
