// Proof that no part of an orbit's period is a period.
#pragma once

#include <vector>

#include "certificate/event_chain.hpp"

namespace peterka::certificate {

// Whether for each prime r that divides q some event of a chain, whose events lie in `places`, surely differs
// from the one q/r cycles later.
[[nodiscard]] bool has_no_smaller_period(const EventChain& chain, const std::vector<Place<Interval>>& places);

}  // namespace peterka::certificate
