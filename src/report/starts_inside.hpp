// Whether the hammer starts inside a compliant stop, beyond the gap: the stop then throws it off at once. (A
// job that starts it inside a rigid stop is refused.)
#pragma once

#include <string>

#include "scene/scene.hpp"

namespace peterka {

// One sentence: how many starts, how deep, and the initial contact force; "" if none is inside. For a map, a
// basin, a sweep or a trace.
[[nodiscard]] std::string starts_inside(const scene::Scene& scene);

}  // namespace peterka
