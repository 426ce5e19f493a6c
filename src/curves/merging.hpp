// Where an orbit of 2q cycles ends because it merges with one of q cycles, which doubles its period there.
//
// Along the branch the two halves of the orbit become equal and then change places, and the branch turns back:
// the same orbits follow, half a period later. No multiplier tells, for det(M - I) touches 0 and goes back.
#pragma once

#include <optional>

#include "curves/branch_step.hpp"

namespace peterka::curves {

// Whether both halves of an orbit are the same motion, but for rounding.
[[nodiscard]] bool halves_are_equal(const Stepper& stepper, const OrbitPoint& point);

// Whether the halves of an orbit become equal, or change places, on a step from one point to another.
[[nodiscard]] bool halves_meet(const Stepper& stepper, const OrbitPoint& from, const OrbitPoint& to);

// The orbit of q cycles where they meet; none where there is none as close as such a step leads.
[[nodiscard]] std::optional<OrbitPoint> merging_orbit(const Stepper& stepper, const OrbitPoint& from,
                                                      const OrbitPoint& to);

// The orbit twice over, as one of twice the period.
[[nodiscard]] OrbitPoint twice(const Rig& rig, const OrbitPoint& point);

}  // namespace peterka::curves
