// The slots of a cell once what is known beside its starts (attractors/known_motions.hpp) has come to them:
// first what starts found, with a share, then what none of them did, with a share of 0. The largest shares and
// what is known are kept.
//
// A run may be killed between two tiles that get theirs, so what starts found has to be told again from the
// file.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "quantities/fields.hpp"

namespace peterka::map_file {

using Slots = std::vector<quantities::StoredAttractor>;  // of a cell, those in use

// As the cell's own search left them: with a share, or that on which [start] ends.
[[nodiscard]] Slots own_slots(const quantities::StoredCell& cell, Slots slots);
// Whether one of these gave way to what is known.
[[nodiscard]] bool lost_slots(const quantities::StoredCell& cell, const Slots& slots, std::int64_t kept);

// `slots`: its own; as many as are kept come out of it, with what is known behind them. start_attractor
// follows.
void add_known(quantities::StoredCell& cell, Slots& slots, std::span<const quantities::StoredAttractor> known,
               std::int64_t kept);

}  // namespace peterka::map_file
