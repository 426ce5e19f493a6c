// Division of a grid of cells into tiles: pure arithmetic that depends on the grid alone.
//
// Cells are numbered row by row (row = gap_ratio or velocity_ratio, column = frequency_ratio or
// displacement_ratio), tiles likewise. A tile is the unit of storing, checking and resuming; tiles at the right
// and upper edge are cropped.
#pragma once

#include <algorithm>
#include <cstdint>

namespace peterka::parallel {

struct Extent {
    std::int64_t rows = 0;
    std::int64_t columns = 0;
    friend bool operator==(const Extent&, const Extent&) = default;
};

// A cell.
struct CellIndex {
    std::int64_t row = 0;
    std::int64_t column = 0;
    friend bool operator==(const CellIndex&, const CellIndex&) = default;
};

inline constexpr Extent tile_extent{16, 16};
// Of cells whose mean lives are computed, each of which may take seconds: a run that stops loses few of them,
// and many ranks share a small map.
inline constexpr Extent tile_extent_of_lives{4, 4};

struct Tile {
    std::int64_t index = 0;
    std::int64_t row = 0;  // of the first cell
    std::int64_t column = 0;
    Extent extent;  // cells inside the grid

    [[nodiscard]] std::int64_t size() const { return extent.rows * extent.columns; }
};

class Tiling {
  public:
    explicit Tiling(Extent grid, Extent largest_tile = tile_extent)
        : grid_(grid),
          largest_tile_(largest_tile),
          tiles_{(grid.rows + largest_tile.rows - 1) / largest_tile.rows,
                 (grid.columns + largest_tile.columns - 1) / largest_tile.columns} {}

    [[nodiscard]] Extent grid() const { return grid_; }
    [[nodiscard]] Extent largest_tile() const { return largest_tile_; }
    [[nodiscard]] Extent tiles() const { return tiles_; }
    [[nodiscard]] std::int64_t count() const { return tiles_.rows * tiles_.columns; }
    [[nodiscard]] Tile tile(std::int64_t index) const {
        const std::int64_t row = index / tiles_.columns * largest_tile_.rows;
        const std::int64_t column = index % tiles_.columns * largest_tile_.columns;
        return {index,
                row,
                column,
                {std::min(largest_tile_.rows, grid_.rows - row),
                 std::min(largest_tile_.columns, grid_.columns - column)}};
    }

    // The tile that contains a cell.
    [[nodiscard]] std::int64_t index_at(const CellIndex& cell) const {
        return cell.row / largest_tile_.rows * tiles_.columns + cell.column / largest_tile_.columns;
    }

  private:
    Extent grid_;
    Extent largest_tile_;
    Extent tiles_;
};

}  // namespace peterka::parallel
