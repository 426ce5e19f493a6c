// The order in which tiles are dealt: scattered over the plane, so that each stretch of it is a fair sample.
//
// Costly cells lie side by side. In this order runs of tiles cost about the same, so ranks finish together
// (postprocess/scaling.py shows it), the remaining time can be estimated from what is done, and the file of an
// interrupted run shows the whole map in part. But a batch of similar cells costs a rank a few per cent less
// than a mixed one: where each rank gets many tiles, they are dealt in squares of 4 x 4, the last quarter one
// by one.
#pragma once

#include <cstdint>
#include <optional>

#include "parallel/tiles.hpp"

namespace peterka::parallel {

// Turns first, first + 1, ..., end - 1 of a DealOrder.
struct TurnRange {
    std::int64_t first = 0;
    std::int64_t end = 0;

    [[nodiscard]] std::int64_t size() const { return end - first; }
    friend bool operator==(const TurnRange&, const TurnRange&) = default;
};

class DealOrder {
  public:
    DealOrder(const Tiling& tiling, int ranks);

    // At least the number of tiles.
    [[nodiscard]] std::int64_t turns() const { return squares_.rows * squares_.columns * side_ * side_; }
    // Each tile has one turn; turns without a tile occur where squares extend beyond the grid.
    [[nodiscard]] std::optional<std::int64_t> tile(std::int64_t turn) const;

  private:
    Extent grid_;
    std::int64_t side_;  // of a square [tiles]
    Extent squares_;
    std::int64_t stride_;       // from square to square, modulo their number
    std::int64_t first_alone_;  // turn from which tiles are dealt one by one
    std::int64_t alone_stride_;
};

}  // namespace peterka::parallel
