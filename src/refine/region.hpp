// The refinement of a rectangle of cells: lattice after lattice, from every 2^levels-th cell to all of them.
//
// What is computed and what is filled follows from the values on the coarser lattices, which surround a cell on
// all sides. A region therefore takes in cells beyond its edges too, ever fewer on finer lattices; regions next
// to each other compute those twice, and need not know of each other. So the value of a cell is the same in any
// region.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "attractors/solved_cell.hpp"
#include "job/job.hpp"
#include "parallel/tiles.hpp"
#include "refine/fill.hpp"
#include "refine/lattice.hpp"

namespace peterka::refine {

// Most regions in progress on a rank: while slow cells of one are awaited, others keep the pool full, but each
// takes memory.
inline constexpr std::size_t most_in_hand = 16;

class Region {
  public:
    Region(const job::Job& job, const parallel::Tile& rectangle);

    // Memory of the cells of a region [bytes].
    [[nodiscard]] static std::int64_t bytes(const job::Job& job, const parallel::Tile& rectangle);

    // Advances to the next lattice with cells that must be computed, and returns these; none once every cell of
    // the rectangle has its value.
    [[nodiscard]] std::vector<parallel::CellIndex> next();
    // The results of these, in their order.
    void put(std::span<const attractors::SolvedCell> results);

    // The cells of a tile inside the rectangle, row by row, once all are there.
    [[nodiscard]] std::vector<attractors::SolvedCell> cells(const parallel::Tile& tile) const;

  private:
    struct Rectangle {
        Interval rows;
        Interval columns;
        [[nodiscard]] std::size_t cells() const;
    };
    [[nodiscard]] static std::vector<Rectangle> needed_for(const job::Job& job,
                                                           const parallel::Tile& rectangle);

    void take_all(std::size_t level);
    void refine(std::size_t level);
    [[nodiscard]] std::size_t index(std::int64_t row, std::int64_t column) const;

    parallel::Extent grid_;
    std::vector<const cell::Quantity*> interpolated_;
    Tries tries_;                    // of each cell
    std::vector<Rectangle> needed_;  // by level: cells whose values are used, on the lattice of stride 2^level
    std::size_t levels_to_do_;
    std::vector<parallel::CellIndex> to_compute_;
    std::vector<attractors::SolvedCell> cells_;  // of the largest rectangle, row by row
};

}  // namespace peterka::refine
