#include "refine/regions.hpp"

namespace peterka::refine {

parallel::Tiling regions_of(parallel::Extent grid, int ranks) {
    constexpr std::int64_t largest = 128;
    constexpr std::int64_t smallest = 32;
    const std::int64_t wanted = 12 * std::int64_t{ranks};
    for (std::int64_t side = largest; side > smallest; side /= 2) {
        const parallel::Tiling regions(grid, {side, side});
        if (regions.count() >= wanted) return regions;
    }
    return parallel::Tiling(grid, {smallest, smallest});
}

parallel::TileSet regions_with(const parallel::TileSet& tiles, const parallel::Tiling& tiling,
                               const parallel::Tiling& regions) {
    parallel::TileSet with(regions.count());
    for (std::int64_t index = 0; index < tiles.tiles(); ++index) {
        if (!tiles.has(index)) continue;
        const parallel::Tile tile = tiling.tile(index);
        with.add(regions.index_at({tile.row, tile.column}));
    }
    return with;
}

std::vector<parallel::Tile> tiles_in(const parallel::Tile& region, const parallel::Tiling& tiling) {
    std::vector<parallel::Tile> tiles;
    for (std::int64_t row = region.row; row < region.row + region.extent.rows;
         row += tiling.largest_tile().rows) {
        for (std::int64_t column = region.column; column < region.column + region.extent.columns;
             column += tiling.largest_tile().columns) {
            tiles.push_back(tiling.tile(tiling.index_at({row, column})));
        }
    }
    return tiles;
}

}  // namespace peterka::refine
