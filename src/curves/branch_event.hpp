// The events between two points of a branch, solved for as points of curves: a Floquet multiplier crosses 1 or
// -1, or an impact is gained or lost.
#pragma once

#include <limits>
#include <optional>

#include "curves/branch_step.hpp"
#include "curves/orbit_check.hpp"
#include "curves/seed.hpp"

namespace peterka::curves {

struct BranchEvent {
    std::optional<Seed> seed;  // the first event
    bool lost = false;         // an event occurred but could not be identified
};

// `fault` is that of the orbit at `to`.
[[nodiscard]] BranchEvent judge(const Stepper& stepper, const OrbitPoint& from, const OrbitPoint& to,
                                const OrbitFault& fault);

// Gives `here`, reached by a step from `from`, the events of its true motion if they differ but the number of
// impacts does not; false if no orbit with these events is found, or if the step is longer than the longest one
// [of the window] in which more than one change can be excluded.
[[nodiscard]] bool change_events(const Stepper& stepper, const Stepper::Here& from, Stepper::Here& here,
                                 double longest_step = std::numeric_limits<double>::infinity());

}  // namespace peterka::curves
