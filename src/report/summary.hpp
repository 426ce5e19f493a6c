// The results of a run, on one screen, for a reader who sees such a map for the first time.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "findings/attractors.hpp"
#include "findings/statistics.hpp"
#include "findings/sweep_attractors.hpp"
#include "findings/sweep_findings.hpp"
#include "job/job.hpp"
#include "map_file/audit_table.hpp"
#include "scene/scene.hpp"

namespace peterka {

// This run alone, as opposed to all the runs that filled the file.
struct RunEffort {
    int ranks = 1;
    double wall_seconds = 0;
};

struct SweepFindings {
    std::vector<BranchFindings> branches = {};
    std::vector<GapAttractors> beside = {};  // of each gap, with [starts]
};

struct RunResults {
    const findings::Statistics& statistics;
    std::optional<map_file::AuditReport> audit;
    std::span<const std::string> omitted;  // sentences: what was left out, and why
    SweepFindings sweep = {};
    std::vector<findings::Attractor> basin = {};
};

struct SummaryInput {
    const scene::Scene& scene;
    const RunResults& findings;
    std::filesystem::path file;
    RunEffort effort;
    std::string borders = {};  // of a map's regimes, in words; empty where none are asked for
};

[[nodiscard]] std::string summary_text(const SummaryInput& input);

}  // namespace peterka
