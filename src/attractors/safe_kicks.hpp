// A lower bound of the critical kick, numerically verified as neighbourhoods of orbits are
// (regime/neighbourhood.hpp): kicks of so many phases, up and down, and of smaller sizes all leave the motion
// where its orbit is known to attract. Half of the largest size that does is the bound: a kick between two
// phases that were tried would have to be twice as hard as its neighbours to lead out.
#pragma once

#include <optional>

#include "attractors/kicked_orbit.hpp"
#include "regime/attractor_table.hpp"
#include "regime/cell_result.hpp"

namespace peterka::attractors {

// Tried from `most` downwards [A0 omega]; nothing where no neighbourhood is known, or where it takes only kicks
// below a thousandth of that. oscillator: of the map of `found`, with or without the cubic spring.
[[nodiscard]] std::optional<double> largest_safe_kick(KickedOrbit& orbit, const regime::AttractorTable& known,
                                                      scene::Oscillator<double> oscillator,
                                                      const regime::FoundAttractor& found, double most);

}  // namespace peterka::attractors
