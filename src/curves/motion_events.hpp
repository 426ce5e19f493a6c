// The events of the true motion that starts from a given state.
#pragma once

#include <optional>
#include <vector>

#include "curves/rig.hpp"
#include "curves/unknowns.hpp"

namespace peterka::curves {

inline constexpr std::size_t most_events = 96;  // of a followed orbit

// The events of the motion over `period` cycles from a state at forcing phase 0; it need not return to it. None
// if it has no impact or more than most_events events, or if it sticks to a rigid stop after complete chatter.
[[nodiscard]] std::optional<Orbit> orbit_from(const Rig& rig, const PlanePoint& place,
                                              const State<double>& start, std::int64_t period);

// The first event of the motion within a time after `from`: in contact a release; in flight a touch or, before
// the hammer has left the stop that has released it, a resume.
[[nodiscard]] std::optional<Event> first_event_after(const PlacedRig& rig, const Event& from, double within);

}  // namespace peterka::curves
