// A set of a grid's tiles, or of other objects numbered from 0: one bit each, so 2 MB for a map of four billion
// cells, whatever its content.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "parallel/tiles.hpp"

namespace peterka::parallel {

class TileSet {
  public:
    // A set of tiles 0, 1, ..., tiles - 1; initially empty.
    explicit TileSet(std::int64_t tiles) : tiles_(tiles), words_(static_cast<std::size_t>((tiles + 63) / 64)) {}
    [[nodiscard]] static TileSet all(std::int64_t tiles);

    void add(std::int64_t tile) { words_[word(tile)] |= bit(tile); }
    [[nodiscard]] bool has(std::int64_t tile) const { return (words_[word(tile)] & bit(tile)) != 0; }
    [[nodiscard]] bool empty() const;
    [[nodiscard]] std::int64_t size() const;                     // number of its members
    [[nodiscard]] std::int64_t tiles() const { return tiles_; }  // number of possible members
    // All bits, to be united with those of other ranks.
    [[nodiscard]] std::span<std::uint64_t> words() { return words_; }

    friend bool operator==(const TileSet&, const TileSet&) = default;

  private:
    static std::size_t word(std::int64_t tile) { return static_cast<std::size_t>(tile) / 64; }
    static std::uint64_t bit(std::int64_t tile) {
        return std::uint64_t{1} << (static_cast<std::uint64_t>(tile) % 64);
    }

    std::int64_t tiles_;
    std::vector<std::uint64_t> words_;
};

// The number of cells in all these tiles.
[[nodiscard]] std::int64_t cells_in(const TileSet& tiles, const Tiling& tiling);

}  // namespace peterka::parallel
