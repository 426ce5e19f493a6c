// A lower bound of the critical kick, verified numerically like neighbourhoods of orbits
// (regime/neighbourhood.hpp): kicks at many phases, up and down, and of smaller sizes, all leave the motion
// where its orbit is known to attract. The bound is half of the largest size for which they do: a kick between
// two tested phases would have to be twice as hard as its neighbours to lead out.
#pragma once

#include <optional>

#include "attractors/kicked_orbit.hpp"
#include "regime/attractor_table.hpp"
#include "regime/cell_result.hpp"

namespace peterka::attractors {

// Tries sizes from `most` downwards [A0 omega]; nothing where no neighbourhood is known, or where only kicks
// below a thousandth of `most` are safe. oscillator: that of the map of `found`, with or without the cubic
// spring.
[[nodiscard]] std::optional<double> largest_safe_kick(KickedOrbit& orbit, const regime::AttractorTable& known,
                                                      scene::Oscillator<double> oscillator,
                                                      const regime::FoundAttractor& found, double most);

}  // namespace peterka::attractors
