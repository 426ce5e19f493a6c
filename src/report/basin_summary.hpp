// On which attractors the starts of a basin end, in words.
#pragma once

#include <span>
#include <string>

#include "findings/attractors.hpp"
#include "scene/scene.hpp"

namespace peterka {

// Each attractor with its share of the starts, its force and its position, which distinguish two of the same
// name; largest shares first. Empty without attractors.
[[nodiscard]] std::string basin_summary(const scene::Scene& scene,
                                        std::span<const findings::Attractor> attractors);

}  // namespace peterka
