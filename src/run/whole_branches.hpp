// The solution of a sweep: one branch after another or, with [starts], all branches of a gap together with the
// attractors at each of its points.
#pragma once

#include <functional>

#include "map_file/map_file.hpp"
#include "parallel/dealing.hpp"
#include "scene/scene.hpp"

namespace peterka {

// Solves a tile and stores it, for one_by_one. Scene and file must outlive it.
[[nodiscard]] std::function<void(const parallel::Tile& tile, const parallel::Poll& poll)> whole_branches(
    const scene::Scene& scene, map_file::MapFile& file);

}  // namespace peterka
