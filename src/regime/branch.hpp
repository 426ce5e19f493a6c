// One branch of a sweep: the steady states along its axis, each reached from the one before.
//
// Up and down, a point starts from the motion on which the last one ended: the hammer keeps its absolute
// position x and velocity x' [m, m/s] at forcing phase 0, where the cart passes its middle, and the cart goes
// on with another speed or amplitude from there. So would a motor leave it that is set to a new speed after the
// motion has settled. In cart coordinates delta' = x'/(A0 omega) - eta changes with eta, delta with the gap,
// and both with the units A0 and omega. A stop that comes closer takes the hammer along: the hammer never lies
// deeper in it than before. From a motion without a proof the next point starts where its run ended, and from a
// failed one where that started. The first point, and each one of a branch with independent starts, starts from
// [start].
//
// The steps are finite, so a jump may come up to a step early where the basin of an attractor is as narrow as
// the step is long.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "regime/cell_result.hpp"
#include "regime/steady_motion.hpp"
#include "scene/scene.hpp"

namespace peterka::regime {

struct BranchPoint {
    CellResult cell;
    SteadyMotion motion;
    double gap = 0;  // [A0]
};

// The points in the order of the axis, whatever the direction. `look`, called every now and then, may throw.
[[nodiscard]] std::vector<BranchPoint> follow_branch(const scene::Scene& scene, std::int64_t row,
                                                     const std::function<void()>& look);

// Marks where peak force jumps from one point to the next in the branch's direction. It changes by more than a
// twentieth of the branch's largest one; by more than twice as much as in the steps before and after between
// motions with a period, as a steep slope is no jump; and one of these begins or ends there that holds for four
// points or up to the end of the branch, since forces scatter between windows in chaos.
void mark_jumps(std::vector<BranchPoint>& points, job::Direction direction);

}  // namespace peterka::regime
