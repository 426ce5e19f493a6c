// Bounds of the largest force of an orbit, by branch and bound over its contacts.
//
// A piece of a contact cannot contain the largest force if the force surely rises or falls throughout, or stays
// below a force attained elsewhere; where it is concave it lies below each of its tangents. Any other piece is
// halved. At first touch the force jumps to chi delta'.
#pragma once

#include <vector>

#include "certificate/event_chain.hpp"

namespace peterka::certificate {

// F/(k A0); nothing() if it cannot be bounded within reasonable effort.
[[nodiscard]] Interval peak_force(const Springs<Interval>& springs, const EventChain& chain,
                                  const std::vector<Place<Interval>>& places);

}  // namespace peterka::certificate
