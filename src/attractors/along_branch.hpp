// All attractors at each point of a sweep, and the motion on each of them: those that a map with the same
// [starts] has there, whatever the branches of the sweep are on.
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

// Those of one point.
struct PointAttractors {
    std::int32_t count = 0;                          // found, more than are kept perhaps
    std::vector<CellAttractor> kept = {};            // in the order of SolvedCell, what is known last
    std::vector<FirstEnd> firsts = {};               // of each of them
    std::vector<regime::SteadyMotion> motions = {};  // the same; nothing where it can't be followed once more
    double gap = 0;                                  // [A0]
};

// All of them, and what is known beside the starts (attractors/known_motions.hpp), of a row of the sweep's
// scene, in the order of the axis. `look`, called every now and then, may throw.
[[nodiscard]] std::vector<PointAttractors> find_along_branch(const scene::Scene& scene, std::int64_t row,
                                                             const std::function<void()>& look);

// Adds the motions that branches ended on at this point, where none of the attractors is
// theirs; and keeps so many: these, what is known, and the largest shares.
void keep_with(PointAttractors& point, std::span<const regime::BranchPoint* const> branches, std::int64_t most);

// Which of those that are kept a motion is on; -1 for none.
[[nodiscard]] std::int32_t slot_of(const PointAttractors& point, const cell::CellResult& motion);

}  // namespace peterka::attractors
