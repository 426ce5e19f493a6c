#include "refine/regions.hpp"

#include <cstddef>

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

std::vector<parallel::TileRange> regions_with(std::span<const parallel::TileRange> tiles,
                                              const parallel::Tiling& tiling, const parallel::Tiling& regions) {
    std::vector<bool> wanted(static_cast<std::size_t>(regions.count()), false);
    for (const parallel::TileRange& range : tiles) {
        for (std::int64_t index = range.first; index < range.end; ++index) {
            const parallel::Tile tile = tiling.tile(index);
            wanted[static_cast<std::size_t>(regions.index_at({tile.row, tile.column}))] = true;
        }
    }
    std::vector<parallel::TileRange> ranges;
    for (std::int64_t region = 0; region < regions.count(); ++region) {
        if (wanted[static_cast<std::size_t>(region)]) parallel::append_tile(ranges, region);
    }
    return ranges;
}

std::vector<parallel::Tile> tiles_in(const parallel::Tile& region, const parallel::Tiling& tiling) {
    std::vector<parallel::Tile> tiles;
    for (std::int64_t row = region.row; row < region.row + region.extent.rows;
         row += parallel::tile_extent.rows) {
        for (std::int64_t column = region.column; column < region.column + region.extent.columns;
             column += parallel::tile_extent.columns) {
            tiles.push_back(tiling.tile(tiling.index_at({row, column})));
        }
    }
    return tiles;
}

}  // namespace peterka::refine
