// Whether a cell can be filled from the cells around it instead of being computed, and with what.
//
// Around it are the cells of its stencils' rows and columns on the coarser lattice, 16 inside a block. It takes
// - their regime and z where all have the same, and every number it is to be filled with is smooth: of three
//   neighbours in a row or column, the one in the middle differs from the mean of the others (or from the line
//   through them) by at most `smoothness` of the largest number. It takes the bicubically interpolated one.
// - chaos where the cells next to it are chaotic, and all but a share of 0.3/stride, where the cells being
// filled
//   lie `stride` apart. Chaos has no smooth numbers: it takes none. Inside chaos lie many narrow periodic
//   windows. A cell that is filled on a coarse lattice decides about its whole block, so the rule is stricter
//   there.
// Where cells have attractors (attractors/), all around must have the same, told apart by their labels, with
// forces and shares that are smooth, too; a share comes in steps of one start.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "attractors/solved_cell.hpp"
#include "cell/quantities.hpp"
#include "job/job.hpp"
#include "refine/lattice.hpp"
#include "regime/cell_result.hpp"

namespace peterka::refine {

// Linear interpolation between such neighbours is off by a quarter of this share, bicubic by far less.
inline constexpr double smoothness = 0.01;

// Those that the job stores and that belong to the steady state, not to the run towards it: a filled cell has
// none.
[[nodiscard]] std::vector<const cell::Quantity*> interpolated_quantities(const job::Job& job);

// The cells at a stencil's rows and columns, which must all be set, and outlive this.
class Surroundings {
  public:
    // stride: of the lattice that the cell in question lies on.
    Surroundings(const Stencil& rows, const Stencil& columns, std::int64_t stride)
        : rows_(rows), columns_(columns), stride_(stride) {}

    void set(std::size_t row, std::size_t column, const attractors::SolvedCell& cell) {
        cells_[row][column] = &cell;
    }

    [[nodiscard]] const Stencil& rows() const { return rows_; }
    [[nodiscard]] const Stencil& columns() const { return columns_; }
    [[nodiscard]] std::int64_t stride() const { return stride_; }
    [[nodiscard]] const regime::CellResult& at(std::size_t row, std::size_t column) const {
        return cells_[row][column]->cell;
    }
    [[nodiscard]] const std::vector<attractors::CellAttractor>& attractors_at(std::size_t row,
                                                                              std::size_t column) const {
        return cells_[row][column]->attractors;
    }

  private:
    const Stencil& rows_;
    const Stencil& columns_;
    std::int64_t stride_;
    std::array<std::array<const attractors::SolvedCell*, 4>, 4> cells_{};
};

// Nothing where a number has none between cells that have it, or isn't smooth: where it bends by more than
// `rough` from its neighbours, or by `smoothness` of the largest, if that is more. NaN where no cell has one.
using Values = std::array<std::array<double, 4>, 4>;
[[nodiscard]] std::optional<double> interpolated(const Surroundings& around, const Values& values,
                                                 double rough = 0);
template <class ValueAt>
[[nodiscard]] Values values_around(const Surroundings& around, const ValueAt& value_at) {
    Values values{};
    for (std::size_t i = 0; i < around.rows().size; ++i) {
        for (std::size_t j = 0; j < around.columns().size; ++j) values[i][j] = value_at(i, j);
    }
    return values;
}

// The cell, or nothing where it must be computed. starts: of each cell, besides [start].
[[nodiscard]] std::optional<attractors::SolvedCell> filled(
    const Surroundings& around, std::span<const cell::Quantity* const> interpolated_ones,
    std::int64_t starts = 0);

}  // namespace peterka::refine
