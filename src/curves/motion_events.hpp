// The events of the true motion from a state on, and what is wrong with an orbit as a motion of the hammer.
#pragma once

#include <optional>
#include <vector>

#include "curves/rig.hpp"
#include "curves/unknowns.hpp"

namespace peterka::curves {

inline constexpr std::size_t most_events = 96;  // of an orbit that is followed

// The orbit of so many cycles that begins in a state at forcing phase 0, as the motion goes on from there; it
// need not return yet. None where it has no impact or more events than most_events, or where a rigid stop holds
// the hammer at the end of a chatter.
[[nodiscard]] std::optional<Orbit> orbit_from(const Rig& rig, const Place& place, const State<double>& start,
                                              std::int64_t period);

}  // namespace peterka::curves
