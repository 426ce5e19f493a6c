// How long the settled motions of a cell just solved last under the disturbances of [noise]
// (noise/mean_life.hpp), if the job has any.
#pragma once

#include <cstdint>

#include "cell/result.hpp"
#include "scene/scene.hpp"

namespace peterka {

// Adds the mean life of a cell's motion or, where its starts end on several, of one of its attractors. Chaotic
// and unresolved motions have none. share: of noise.cycles, to be computed.
void add_mean_life(const scene::Scene& scene, std::int64_t row, std::int64_t column, cell::CellResult& result,
                   double share = 1);
void add_mean_life(const scene::Scene& scene, std::int64_t row, std::int64_t column,
                   cell::CellAttractor& attractor, double share = 1);

}  // namespace peterka
