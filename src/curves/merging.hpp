// Where an orbit of 2q cycles ends by merging with one of q cycles, at a period doubling of the latter.
//
// Along the branch the two halves of the orbit become equal and then change places, and the branch turns back:
// the same orbits follow, half a period later. No multiplier indicates it, since det(M - I) touches 0 without a
// change of sign.
#pragma once

#include <optional>

#include "curves/branch_step.hpp"

namespace peterka::curves {

// Whether both halves of an orbit are the same motion up to rounding.
[[nodiscard]] bool halves_are_equal(const Stepper& stepper, const OrbitPoint& point);

// Whether the halves of an orbit become equal, or change places, during a step.
[[nodiscard]] bool halves_meet(const Stepper& stepper, const OrbitPoint& from, const OrbitPoint& to);

// The orbit of q cycles where they meet; none if none is found within reach of the step.
[[nodiscard]] std::optional<OrbitPoint> merging_orbit(const Stepper& stepper, const OrbitPoint& from,
                                                      const OrbitPoint& to);

// The same on a curve of folds, which ends there: the orbit of 2q cycles, to which that of q cycles has lost
// its stability at a degenerate period doubling.
[[nodiscard]] std::optional<OrbitPoint> merging_fold(const Stepper& stepper, const OrbitPoint& from,
                                                     const OrbitPoint& to);

// The orbit followed twice over, as one of twice the period.
[[nodiscard]] OrbitPoint twice(const Rig& rig, const OrbitPoint& point);

}  // namespace peterka::curves
