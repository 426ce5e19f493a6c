// Which turn is dealt next, and how many tiles at a time: pure arithmetic, no MPI.
#pragma once

#include <cstdint>

#include "parallel/deal_order.hpp"
#include "parallel/tile_set.hpp"

namespace peterka::parallel {

// The number of tiles per deal. Two bounds: a share of all tiles, so that no rank has much work ahead of it,
// and a share of the remaining tiles (factoring; Hummel, Schonberg & Flynn 1992), so that runs shrink towards
// the end and all ranks finish together.
[[nodiscard]] std::int64_t deal_size(std::int64_t remaining_tiles, std::int64_t all_tiles, int ranks);

class TilePool {
  public:
    // Deals the set's tiles in this order.
    TilePool(const DealOrder& order, TileSet tiles);

    [[nodiscard]] const DealOrder& order() const { return order_; }
    [[nodiscard]] std::int64_t remaining() const { return remaining_; }
    [[nodiscard]] std::int64_t all() const { return all_; }  // remaining() at construction
    // The next turns in a row, at most `limit` of them; none if nothing is left.
    [[nodiscard]] TurnRange take(std::int64_t limit);

  private:
    [[nodiscard]] bool has(std::int64_t turn) const;

    DealOrder order_;
    TileSet tiles_;
    std::int64_t turn_ = 0;
    std::int64_t all_;
    std::int64_t remaining_;
};

}  // namespace peterka::parallel
