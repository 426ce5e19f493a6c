// One rank's solving of the tiles that it is dealt: their cells side by side in one pool, in whatever order
// they come to an end.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "parallel/dealing.hpp"
#include "regime/cell_result.hpp"
#include "scene/scene.hpp"

namespace peterka {

struct TileWork {
    // Cells of the tile that are to be solved: numbered within the tile, row by row, in rising order.
    std::function<std::vector<std::int64_t>(const parallel::Tile& tile)> cells_to_solve;
    // Their results, in the same order, and the seconds of computing that they took.
    std::function<void(const parallel::Tile& tile, std::span<const regime::CellResult> results, double seconds)>
        store;
};

// For DealtWork::solve.
void solve_tiles(const scene::Scene& scene, const TileWork& work, parallel::TileSource& source);

}  // namespace peterka
