// Where a hammer grazes the stop while its acceleration is 0, too.
//
// A grazing in flight is the highest point of a hop: the acceleration leads away from the stop. A grazing at
// which the stop goes on to press is the lowest point of a flight beyond the surface, from which the hammer is
// lifted back towards the stop that has let go. The curves of both end where the two points are one, an
// inflection.
#pragma once

#include <optional>

#include "curves/rig.hpp"
#include "curves/unknowns.hpp"

namespace peterka::curves {

// Whether a grazing orbit has passed an inflection on the way from here to there, with the same events.
[[nodiscard]] bool grazing_turns_over(const Rig& rig, const OrbitPoint& here, const OrbitPoint& there);

// With a grazing at which the stop doesn't go on to press: at an inflection both are one. None where other
// events follow than the end of the contact.
[[nodiscard]] std::optional<OrbitPoint> with_brief_grazing(const OrbitPoint& point);

}  // namespace peterka::curves
