// Unstable orbits at a requested gap: from a point of a curve, where they separate from stable ones, along the
// other axis, usually the frequency, to the next such point, so that a hysteresis loop closes.
#pragma once

#include <cstdint>
#include <vector>

#include "curves/trace_curve.hpp"

namespace peterka::curves {

struct BranchPoint {
    double along = 0;        // coordinate on the axis along which it is followed
    double frequency = 0;    // Omega/omega
    double gap = 0;          // gap/A0
    double force_ratio = 1;  // F/(m g0) of a force k A0
    double multiplier = 0;   // as in CurvePoint
    double peak_force = 0;   // F/(k A0)
    double residual = 0;
    std::vector<State<double>> at_phase_0;  // (delta, delta') once per cycle
    std::vector<double> impact_times;       // tau of each impact, as in the orbit's events
};

// Why a branch ends.
enum class BranchEnd : std::int8_t { border = 0, fold = 1, period_doubling = 2, grazing = 3, lost = 4 };

struct UnstableBranch {
    double gap = 0;  // coordinate on its axis
    std::int64_t impacts = 0;
    std::int64_t period = 1;
    std::vector<BranchPoint> points;
    BranchEnd begins = BranchEnd::lost;
    BranchEnd ends = BranchEnd::lost;
};

// The branches that begin at a point of a curve. Where impacts are gained or lost on the way, each pattern is a
// branch of its own.
[[nodiscard]] std::vector<UnstableBranch> unstable_branches(const Rig& rig, const Seed& seed,
                                                            const Window& window);

// Whether two branches are the same, possibly found from opposite ends.
[[nodiscard]] bool is_same_branch(const UnstableBranch& a, const UnstableBranch& b);

}  // namespace peterka::curves
