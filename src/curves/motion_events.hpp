// The events of the true motion from a state on.
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
[[nodiscard]] std::optional<Orbit> orbit_from(const Rig& rig, const PlanePoint& place,
                                              const State<double>& start, std::int64_t period);

// What the motion meets first within so long a time after an event: in contact a release; in flight a touch,
// or, before the hammer has left the stop that has let go, a resume.
[[nodiscard]] std::optional<Event> first_event_after(const PlacedRig& rig, const Event& from, double within);

}  // namespace peterka::curves
