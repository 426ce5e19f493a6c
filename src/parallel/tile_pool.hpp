// Which tiles are still to be dealt, and how many of them at a time: pure arithmetic, no MPI.
//
// Tiles are kept as ranges, so the memory follows from the number of gaps in a resumed file, not from its size.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "parallel/tiles.hpp"

namespace peterka::parallel {

// Tiles first, first + 1, ..., end - 1.
struct TileRange {
    std::int64_t first = 0;
    std::int64_t end = 0;

    [[nodiscard]] std::int64_t size() const { return end - first; }
    friend bool operator==(const TileRange&, const TileRange&) = default;
};

// Appends tiles to ranges in rising order, lengthening the last range where they follow it.
void append_tiles(std::vector<TileRange>& ranges, TileRange tiles);
inline void append_tile(std::vector<TileRange>& ranges, std::int64_t tile) {
    append_tiles(ranges, {tile, tile + 1});
}

[[nodiscard]] std::int64_t tiles_in(std::span<const TileRange> ranges);

// Cells in all these tiles.
[[nodiscard]] std::int64_t cells_in(std::span<const TileRange> ranges, const Tiling& tiling);

// How many tiles a deal hands out. Two bounds: a share of all tiles, because costly cells lie side by side (a
// quarter of a map's tiles, dealt as one run, can hold more than half of its work), and a share of what remains
// (factoring), so that runs shrink towards the end and all ranks finish together.
[[nodiscard]] std::int64_t deal_size(std::int64_t remaining_tiles, std::int64_t all_tiles, int ranks);

class TilePool {
  public:
    explicit TilePool(std::vector<TileRange> ranges);

    [[nodiscard]] std::int64_t remaining() const { return remaining_; }
    [[nodiscard]] std::int64_t all() const { return all_; }  // remaining() when the pool was made
    // The next run of neighbouring tiles, at most `limit` of them; empty if nothing is left.
    [[nodiscard]] TileRange take(std::int64_t limit);

  private:
    std::vector<TileRange> ranges_;
    std::size_t current_ = 0;
    std::int64_t all_ = 0;
    std::int64_t remaining_ = 0;
};

}  // namespace peterka::parallel
