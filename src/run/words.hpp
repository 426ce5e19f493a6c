// What a run prints at its end, and what its file says about the machines.
#pragma once

#include <fmt/format.h>

#include <string>

#include "parallel/hosts.hpp"
#include "run/run_plan.hpp"
#include "support/print.hpp"

namespace peterka {

// Called once the file is closed. If printing fails, no work is lost, and the Failure says so.
inline void print_of_file(const std::string& words, const RunPlan& plan) {
    if (words.empty()) return;
    print(words, fmt::format("{} is complete", plan.file.string()));
}

inline void print_complete(const RunPlan& plan) {
    if (!plan.quiet) {
        print_of_file(fmt::format("{} is complete: nothing is computed\n", plan.file.string()), plan);
    }
}

// Collective: the names of all ranks' hosts; none if the job is to be anonymous.
inline std::string host_names(const parallel::Session& session, const RunPlan& plan) {
    const std::string names = parallel::host_names(session);
    return plan.job.output.anonymous ? "" : names;
}

}  // namespace peterka
