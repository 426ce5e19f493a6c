// Unstable orbits at a gap that was asked for: from a point of a curve, where they part from stable ones, along
// the axis that isn't the gap's, usually the frequency, to the next such point, so that a loop of hysteresis
// closes.
#pragma once

#include <cstdint>
#include <vector>

#include "curves/trace_curve.hpp"

namespace peterka::curves {

struct BranchPoint {
    double along = 0;        // coordinate on the axis that it is followed along
    double frequency = 0;    // Omega/omega
    double gap = 0;          // gap/A0
    double force_ratio = 1;  // F/(m g0) of a force k A0
    double multiplier = 0;   // as that of a CurvePoint
    double peak_force = 0;   // F/(k A0)
    double residual = 0;
    std::vector<State<double>> at_phase_0;  // (delta, delta') once a cycle
    std::vector<double> impact_times;       // tau of each impact, in the orbit's own count
};

// Why a branch goes no further.
enum class BranchEnd : std::int8_t { border = 0, fold = 1, period_doubling = 2, grazing = 3, lost = 4 };

struct UnstableBranch {
    double gap = 0;  // coordinate on its axis
    std::int64_t impacts = 0;
    std::int64_t period = 1;
    std::vector<BranchPoint> points;
    BranchEnd begins = BranchEnd::lost;
    BranchEnd ends = BranchEnd::lost;
};

// Those that begin at a point of a curve; where impacts are gained or lost on the way each pattern is a branch
// of its own.
[[nodiscard]] std::vector<UnstableBranch> unstable_branches(const Rig& rig, const Seed& seed,
                                                            const Window& window);

// Whether a branch is one that was found from its other end.
[[nodiscard]] bool is_same_branch(const UnstableBranch& a, const UnstableBranch& b);

}  // namespace peterka::curves
