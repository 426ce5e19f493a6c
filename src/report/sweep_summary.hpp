// What the branches of a sweep show, gap by gap, as lines of a summary.
#pragma once

#include <span>
#include <string>

#include "findings/sweep_attractors.hpp"
#include "findings/sweep_findings.hpp"
#include "scene/scene.hpp"

namespace peterka {

// `branches` in the order of the sweep; `beside`: one per gap, with [starts].
[[nodiscard]] std::string sweep_text(const scene::Scene& scene, std::span<const BranchFindings> branches,
                                     std::span<const GapAttractors> beside = {});

}  // namespace peterka
