// Whose turn it is to be dealt, and how many tiles at a time: pure arithmetic, no MPI.
//
// Turns are kept in stretches, so the memory follows from the number of gaps in a resumed file, not from its
// size.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "parallel/tile_set.hpp"

namespace peterka::parallel {

// Turns first, first + 1, ..., end - 1 of a DealOrder.
struct Turns {
    std::int64_t first = 0;
    std::int64_t end = 0;

    [[nodiscard]] std::int64_t size() const { return end - first; }
    friend bool operator==(const Turns&, const Turns&) = default;
};

// How many tiles a deal hands out. Two bounds: a share of all tiles, so that no rank has much before it, and a
// share of what remains (factoring), so that runs shrink towards the end and all ranks finish together.
[[nodiscard]] std::int64_t deal_size(std::int64_t remaining_tiles, std::int64_t all_tiles, int ranks);

class TilePool {
  public:
    explicit TilePool(const TileSet& tiles);

    [[nodiscard]] std::int64_t remaining() const { return remaining_; }
    [[nodiscard]] std::int64_t all() const { return all_; }  // remaining() when the pool was made
    // The next turns in a row, at most `limit` of them; none if nothing is left.
    [[nodiscard]] Turns take(std::int64_t limit);

  private:
    std::vector<Turns> stretches_;
    std::size_t current_ = 0;
    std::int64_t all_ = 0;
    std::int64_t remaining_ = 0;
};

}  // namespace peterka::parallel
