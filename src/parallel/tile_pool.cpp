#include "parallel/tile_pool.hpp"

#include <algorithm>
#include <utility>

namespace peterka::parallel {

void append_tiles(std::vector<TileRange>& ranges, TileRange tiles) {
    if (!ranges.empty() && ranges.back().end == tiles.first) {
        ranges.back().end = tiles.end;
    } else {
        ranges.push_back(tiles);
    }
}

std::int64_t tiles_in(std::span<const TileRange> ranges) {
    std::int64_t tiles = 0;
    for (const TileRange& range : ranges) tiles += range.size();
    return tiles;
}

std::int64_t cells_in(std::span<const TileRange> ranges, const Tiling& tiling) {
    std::int64_t cells = 0;
    for (const TileRange& range : ranges) {
        for (std::int64_t tile = range.first; tile < range.end; ++tile) cells += tiling.tile(tile).size();
    }
    return cells;
}

std::int64_t deal_size(std::int64_t remaining_tiles, std::int64_t all_tiles, int ranks) {
    // A run is asked for early, and a tile takes milliseconds: 64 runs per rank are few. Half of what remains
    // goes out in one round of equal runs.
    const std::int64_t longest = std::max<std::int64_t>(all_tiles / (64 * std::int64_t{ranks}), 1);
    const std::int64_t shares = 2 * std::int64_t{ranks};
    return std::min((remaining_tiles + shares - 1) / shares, longest);
}

TilePool::TilePool(std::vector<TileRange> ranges) : ranges_(std::move(ranges)) {
    std::erase_if(ranges_, [](const TileRange& range) { return range.size() <= 0; });
    for (const TileRange& range : ranges_) all_ += range.size();
    remaining_ = all_;
}

TileRange TilePool::take(std::int64_t limit) {
    if (current_ == ranges_.size() || limit <= 0) return {};
    TileRange& range = ranges_[current_];
    const TileRange taken{range.first, std::min(range.end, range.first + limit)};
    range.first = taken.end;
    remaining_ -= taken.size();
    if (range.size() == 0) ++current_;
    return taken;
}

}  // namespace peterka::parallel
