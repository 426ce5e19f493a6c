// Where the hammer grazes the stop with zero acceleration, a codimension-2 point (Kowalczyk et al. 2006).
//
// A grazing in flight is a maximum of delta: the acceleration points away from the stop. A grazing at which the
// stop goes on to press is a minimum of a flight beyond the surface, from which the hammer is driven back
// towards the stop that has released it. The curves of both kinds end where maximum and minimum coincide, at an
// inflection.
#pragma once

#include <optional>

#include "curves/rig.hpp"
#include "curves/unknowns.hpp"

namespace peterka::curves {

// Whether a grazing orbit passes an inflection on the way from `here` to `there`, with the same events.
[[nodiscard]] bool grazing_turns_over(const Rig& rig, const OrbitPoint& here, const OrbitPoint& there);

// The orbit with a grazing at which the stop doesn't go on to press: at an inflection the two coincide. None if
// an event other than the end of the contact follows.
[[nodiscard]] std::optional<OrbitPoint> with_brief_grazing(const OrbitPoint& point);

}  // namespace peterka::curves
