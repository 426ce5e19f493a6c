// What happens to an orbit between two points of a branch: a multiplier through 1 or -1, an impact gained or
// lost; solved for as a point of a curve.
#pragma once

#include <optional>

#include "curves/branch_step.hpp"
#include "curves/orbit_check.hpp"
#include "curves/seed.hpp"

namespace peterka::curves {

struct BranchEvent {
    std::optional<Seed> seed;  // what happens first
    bool lost = false;         // something happened, but it isn't known what
};

// `fault` is what the orbit has at the farther point. Without `by_multipliers` only impacts count: at a point
// of a curve a multiplier is 1 or -1 but for rounding.
[[nodiscard]] BranchEvent judge(const Stepper& stepper, const OrbitPoint& from, const OrbitPoint& to,
                                const OrbitFault& fault, bool by_multipliers = true);

// Gives the point to which a step came `from` another the events of its true motion where these are others, but
// as many impacts; false where it has no orbit with them.
[[nodiscard]] bool change_events(const Stepper& stepper, const Stepper::Here& from, Stepper::Here& here);

}  // namespace peterka::curves
