#include "parallel/tile_pool.hpp"

#include <algorithm>

#include "parallel/deal_order.hpp"

namespace peterka::parallel {

std::int64_t deal_size(std::int64_t remaining_tiles, std::int64_t all_tiles, int ranks) {
    // A run is asked for early, and a tile takes milliseconds: 16 runs per rank are few, so that rank 0 has
    // time for many ranks. Half of what remains goes out in one round of equal runs.
    const std::int64_t longest = std::max<std::int64_t>(all_tiles / (16 * std::int64_t{ranks}), 1);
    const std::int64_t shares = 2 * std::int64_t{ranks};
    return std::min((remaining_tiles + shares - 1) / shares, longest);
}

TilePool::TilePool(const TileSet& tiles) {
    const DealOrder order(tiles.tiles());
    for (std::int64_t turn = 0; turn < tiles.tiles(); ++turn) {
        if (!tiles.has(order.tile(turn))) continue;
        if (stretches_.empty() || stretches_.back().end != turn) stretches_.push_back({turn, turn});
        ++stretches_.back().end;
        ++all_;
    }
    remaining_ = all_;
}

Turns TilePool::take(std::int64_t limit) {
    if (current_ == stretches_.size() || limit <= 0) return {};
    Turns& stretch = stretches_[current_];
    const Turns taken{stretch.first, std::min(stretch.end, stretch.first + limit)};
    stretch.first = taken.end;
    remaining_ -= taken.size();
    if (stretch.size() == 0) ++current_;
    return taken;
}

}  // namespace peterka::parallel
