// Division of a map into regions, the units in which a refined map is distributed: pure arithmetic.
//
// Regions consist of whole tiles. They depend on the grid and the number of ranks, and so does what is computed
// twice at their edges, but no value.
#pragma once

#include <vector>

#include "parallel/tile_set.hpp"
#include "parallel/tiles.hpp"

namespace peterka::refine {

// Large regions, so that little is computed twice, but at least a dozen per rank where the map has as many.
[[nodiscard]] parallel::Tiling regions_of(parallel::Extent grid, int ranks);

// The regions that hold any of these tiles.
[[nodiscard]] parallel::TileSet regions_with(const parallel::TileSet& tiles, const parallel::Tiling& tiling,
                                             const parallel::Tiling& regions);

// The tiles of a region.
[[nodiscard]] std::vector<parallel::Tile> tiles_in(const parallel::Tile& region,
                                                   const parallel::Tiling& tiling);

}  // namespace peterka::refine
