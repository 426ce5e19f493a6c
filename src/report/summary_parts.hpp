// The parts of a summary (report/summary.hpp), each in a source file of its own name, in the summary's order. A
// part is "" where the job does not ask for it.
#pragma once

#include <span>
#include <string>

#include "findings/attractors.hpp"
#include "findings/kick_counts.hpp"
#include "findings/life_findings.hpp"
#include "findings/start_findings.hpp"
#include "findings/statistics.hpp"
#include "findings/sweep_attractors.hpp"
#include "findings/sweep_findings.hpp"
#include "job/job.hpp"
#include "map_file/audit_table.hpp"
#include "scene/scene.hpp"

namespace peterka {

// On which attractors the starts of a basin end: each with its share of the starts, its force and its position,
// which distinguish two of the same name; largest shares first.
[[nodiscard]] std::string basin_summary(const scene::Scene& scene,
                                        std::span<const findings::Attractor> attractors);

// What it takes to distinguish chaos from a long transient: the value of max_cycles that chaotic_so_far cells
// require, and its cost; "" if there are none.
[[nodiscard]] std::string long_chaos(const scene::Scene& scene, const findings::Statistics& statistics);

// What many starts in each cell show about a map.
[[nodiscard]] std::string starts_summary(const scene::Scene& scene, const findings::StartFindings& findings);

// The kicks that the settled motions of a map withstand.
[[nodiscard]] std::string kicks_summary(const scene::Scene& scene, const findings::KickCounts& counts);

// How long settled motions last under the disturbances of [noise].
[[nodiscard]] std::string lives_summary(const scene::Scene& scene, const findings::LifeFindings& all);

// What the peak force, or on a rigid stop the impact speed, of a map's commonest orbits depends on; "" if no
// orbit has an elasticity.
[[nodiscard]] std::string elasticities_summary(const job::Job& job, const findings::Statistics& statistics);

// What the branches of a sweep show, gap by gap. `branches` in the order of the sweep; `beside`: one per gap,
// with [starts].
[[nodiscard]] std::string sweep_summary(const scene::Scene& scene, std::span<const BranchFindings> branches,
                                        std::span<const GapAttractors> beside = {});

// How much of a map is proved in interval arithmetic, and why the rest isn't.
[[nodiscard]] std::string certificate_summary(const scene::Scene& scene,
                                              const findings::Statistics& statistics);

// The result of an audit. seconds_per_cell: of the map itself, on average.
[[nodiscard]] std::string audit_summary(const map_file::AuditReport& audit, double seconds_per_cell);

}  // namespace peterka
