// All attractors at each point of a sweep, and the motion on each: those that a map with the same [starts] has
// there, regardless of the branches that the sweep follows.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "attractors/solved_cell.hpp"
#include "regime/branch.hpp"
#include "regime/steady_motion.hpp"
#include "scene/scene.hpp"

namespace peterka::attractors {

// The attractors of one point.
struct PointAttractors {
    std::int32_t count = 0;                // found, possibly more than are kept
    std::vector<CellAttractor> kept = {};  // in the order of SolvedCell; known motions without starts last
    std::vector<FirstEnd> firsts = {};     // of each kept attractor
    std::vector<regime::SteadyMotion> motions = {};  // likewise; empty where it cannot be followed again
    double gap = 0;                                  // [A0]
    cell::CellResult of_rigs = {};                   // what it tells of the rigs drawn, if they are uncertain
    std::vector<CellOutcome> outcomes = {};
};

// The attractors of a row of the sweep's scene, including those known without a start
// (attractors/known_motions.hpp), in the order of the axis. `look` is called from time to time and may throw.
[[nodiscard]] std::vector<PointAttractors> find_along_branch(const scene::Scene& scene, std::int64_t row,
                                                             const std::function<void()>& look);

// Only what the rigs drawn at each point of a row tell, for a job with [uncertainty] and no [starts].
[[nodiscard]] std::vector<PointAttractors> find_outcomes_along_branch(const scene::Scene& scene,
                                                                      std::int64_t row,
                                                                      const std::function<void()>& look);

// Adds the motions on which branches ended at this point, unless an attractor matches, and keeps at most
// `most`: these, the known ones, and the largest shares.
void keep_with(PointAttractors& point, std::span<const regime::BranchPoint* const> branches, std::int64_t most);

// The slot of the kept attractor that a motion is on; -1 for none.
[[nodiscard]] std::int32_t slot_of(const PointAttractors& point, const cell::CellResult& motion);

}  // namespace peterka::attractors
