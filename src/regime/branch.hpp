// One branch of a sweep: the steady states along its axis, each reached from the previous one.
//
// In directions up and down, a point starts from the motion on which the previous one ended: at forcing phase
// 0, where the cart passes its middle, the hammer keeps its absolute position x and velocity x' [m, m/s], and
// the cart continues with the new speed or amplitude. A motor set to a new speed once the motion has settled
// does the same. In cart coordinates delta' = x'/(A0 omega) - eta changes with eta, delta with the gap, and
// both with the units A0 and omega. A stop that moves closer pushes the hammer along: the hammer never lies
// deeper in it than before. After a motion without a proof the next point starts where that run ended, and
// after a failed one where that run started. The first point, and every point of a branch with independent
// starts, starts from [start].
//
// The steps are finite, so a jump may occur up to one step early where the basin of an attractor is as narrow
// as a step.
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

// The columns of a branch in the order in which it visits them.
[[nodiscard]] std::vector<std::int64_t> columns_of(const scene::Scene& scene, std::int64_t row);

// The end of a motion, at forcing phase 0 of its cell.
struct Ended {
    scene::State<double> state;  // (delta, x'/(A0 omega))
    double gap = 0;              // [A0]
    scene::Scales scales;
};

// Follows a branch from point to point; columns that are left out make a longer step.
class BranchWalk {
  public:
    // The scene must outlive this.
    BranchWalk(const scene::Scene& scene, std::int64_t row) : scene_(scene), row_(row) {}
    [[nodiscard]] BranchPoint to(std::int64_t column, const std::function<void()>& look);

  private:
    const scene::Scene& scene_;
    std::int64_t row_;
    std::optional<Ended> last_;
};

// The points in the order of the axis, whatever the direction, without their jumps. `look`, called
// periodically, may throw.
[[nodiscard]] std::vector<BranchPoint> follow_branch(const scene::Scene& scene, std::int64_t row,
                                                     const std::function<void()>& look);

// Marks where the peak force or, on a rigid stop, which has none, the largest impact speed jumps from one point
// to the next in the branch's direction: the change exceeds a twentieth of the branch's largest; it exceeds
// twice the change in the steps before and after between motions with a period, as a steep slope is no
// jump, 2.5 times where the motion stays or its period doubles, and once where neither that nor a grazing leads
// from one motion with impacts to the next; and, since forces scatter between windows in chaos, a motion with a
// period begins or ends there that persists for four points or up to the end of the branch, or one begins or
// ends where the change exceeds twice each of the four before and after it.
void mark_jumps(std::vector<BranchPoint>& points, job::Direction direction);

// The same for a branch of a sweep, and, as the way into a fold may be as steep as what follows: where the
// change exceeds a twentieth of the branch's largest between motions with a period that differ in kind, or by
// more than in the steps beside it, the step is halved ten times towards the larger change, and holds a jump if
// more than half of the change is left. Not of independent starts.
void mark_jumps(const scene::Scene& scene, std::int64_t row, std::vector<BranchPoint>& points,
                const std::function<void()>& look);

}  // namespace peterka::regime
