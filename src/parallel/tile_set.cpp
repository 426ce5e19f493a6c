#include "parallel/tile_set.hpp"

#include <algorithm>
#include <bit>

namespace peterka::parallel {

TileSet TileSet::all(std::int64_t tiles) {
    TileSet set(tiles);
    for (std::int64_t tile = 0; tile < tiles; ++tile) set.add(tile);
    return set;
}

bool TileSet::empty() const {
    return std::ranges::all_of(words_, [](std::uint64_t word) { return word == 0; });
}

std::int64_t TileSet::size() const {
    std::int64_t count = 0;
    for (const std::uint64_t word : words_) count += std::popcount(word);
    return count;
}

std::int64_t cells_in(const TileSet& tiles, const Tiling& tiling) {
    std::int64_t cells = 0;
    for (std::int64_t tile = 0; tile < tiles.tiles(); ++tile) {
        if (tiles.has(tile)) cells += tiling.tile(tile).size();
    }
    return cells;
}

}  // namespace peterka::parallel
