// The slots of a cell after adding attractors known independently of its starts (attractors/known_motions.hpp):
// first those that starts found, with a share, then those that no start found, with a share of 0. The largest
// shares and the known attractors are kept; where starts found more than there is room for, no known one is
// added, as it could be one of these.
//
// A run may be killed between two tiles, so what starts found must be recoverable from the file.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "quantities/fields.hpp"

namespace peterka::map_file {

using Slots = std::vector<quantities::StoredAttractor>;  // of a cell, those in use

// The slots that the cell's own search found: those with a share, and that on which [start] ends.
[[nodiscard]] Slots own_slots(const quantities::StoredCell& cell, Slots slots);
// Whether a known attractor displaced one of these.
[[nodiscard]] bool lost_slots(const quantities::StoredCell& cell, const Slots& slots, std::int64_t kept);

// `slots`: the cell's own; reduced to at most `kept`, with known attractors last. Updates start_attractor.
void add_known(quantities::StoredCell& cell, Slots& slots, std::span<const quantities::StoredAttractor> known,
               std::int64_t kept);

}  // namespace peterka::map_file
