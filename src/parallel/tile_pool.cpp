#include "parallel/tile_pool.hpp"

#include <algorithm>
#include <utility>

#include "support/expect.hpp"

namespace peterka::parallel {

std::int64_t deal_size(std::int64_t remaining_tiles, std::int64_t all_tiles, int ranks) {
    // 16 runs per rank leave rank 0 time to serve many ranks, and the longest runs are short compared with the
    // whole. Half of what remains goes out in one round of equal runs.
    PETERKA_EXPECT(0 <= remaining_tiles && remaining_tiles <= all_tiles && ranks > 0);
    const std::int64_t longest = std::max<std::int64_t>(all_tiles / (16 * std::int64_t{ranks}), 1);
    const std::int64_t shares = 2 * std::int64_t{ranks};
    return std::min((remaining_tiles + shares - 1) / shares, longest);
}

TilePool::TilePool(const DealOrder& order, TileSet tiles)
    : order_(order), tiles_(std::move(tiles)), all_(tiles_.size()), remaining_(all_) {
    PETERKA_EXPECT(tiles_.tiles() <= order.turns());
}

bool TilePool::has(std::int64_t turn) const {
    if (turn >= order_.turns()) return false;
    const auto tile = order_.tile(turn);
    return tile && tiles_.has(*tile);
}

TurnRange TilePool::take(std::int64_t limit) {
    if (remaining_ == 0 || limit <= 0) return {};
    while (!has(turn_)) ++turn_;
    const std::int64_t first = turn_;
    while (turn_ - first < limit && has(turn_)) ++turn_;
    remaining_ -= turn_ - first;
    return {first, turn_};
}

}  // namespace peterka::parallel
