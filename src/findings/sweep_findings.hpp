// Findings in the branches of a sweep: strongest impacts, bands of one kind of motion, jumps, and hysteresis.
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "findings/statistics.hpp"
#include "job/job.hpp"
#include "quantities/fields.hpp"

namespace peterka {

// The class of a cell's motion: its regime, and z = p/q if it is periodic.
struct MotionClass {
    regime::Regime regime = regime::Regime::failed;
    findings::ImpactClass z;  // 0/0 unless periodic
    friend auto operator<=>(const MotionClass&, const MotionClass&) = default;
};

// Neighbouring points of one class, both ends included, as columns of the branch.
struct Band {
    MotionClass motion;
    std::int64_t first = 0;
    std::int64_t last = 0;
    [[nodiscard]] std::int64_t points() const { return last - first + 1; }
};

// The peak force or, on a rigid stop, the largest impact speed [m/s]; NaN where that isn't stored.
[[nodiscard]] inline double blow(const quantities::StoredCell& cell) {
    return std::isnan(cell.peak_force) ? cell.impact_speed : cell.peak_force;
}

// From the last point before a jump to the first one after it, in the branch's direction.
struct Jump {
    std::int64_t from = 0;
    std::int64_t to = 0;
};

// Columns first to last.
struct Stretch {
    std::int64_t first = 0;
    std::int64_t last = 0;
};

// What lies beside a point along the frequencies. If both sides are its own band, a largest force is a maximum
// inside it: a resonance. Otherwise the force may merely be cut off.
enum class Side { own_band, other_band, jump, end_of_sweep };
struct Surroundings {
    Side below = Side::own_band;
    Side above = Side::own_band;
    [[nodiscard]] bool inside() const { return below == Side::own_band && above == Side::own_band; }
};

struct BranchFindings {
    job::Branch branch;
    std::vector<quantities::StoredCell> cells = {};  // along the frequencies
    // columns of the largest peak force among z = 1/1 and among all
    std::optional<std::int64_t> one_to_one = {};
    std::optional<std::int64_t> largest = {};
    Surroundings around_one_to_one = {};                            // of one_to_one
    std::vector<Jump> jumps = {};                                   // in the branch's direction
    std::vector<Band> bands = {};                                   // along the frequencies
    std::vector<std::pair<MotionClass, std::int64_t>> points = {};  // of each class, most frequent first
};

[[nodiscard]] MotionClass motion_class(const quantities::StoredCell& cell);
[[nodiscard]] BranchFindings find_in_branch(const job::Branch& branch,
                                            std::vector<quantities::StoredCell> cells);

// The stretches in which sweeping up and down lead to different motions: a different class, chaos among them,
// or a peak force that differs by more than 1 %. Points that are chaotic on both ways end a stretch, as their
// forces are those of what was observed; unresolved and failed ones neither begin, end nor interrupt one.
[[nodiscard]] std::vector<Stretch> find_hysteresis(const BranchFindings& up, const BranchFindings& down);

}  // namespace peterka
