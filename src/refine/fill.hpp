// Whether a cell can be filled from the cells around it instead of being computed, and with which values.
//
// Around it are the cells in its stencils' rows and columns on the coarser lattice, 16 inside a block. It takes
// - their regime and z if all have the same, and every number it is to be filled with is smooth: of three
//   neighbours in a row or column, the middle one differs from the mean of the others (or from the line through
//   them) by at most `smoothness` of the largest number. These numbers are interpolated bicubically.
// - chaos if the cells next to it are chaotic, and all but a share of 0.3/stride of those around, where the
//   cells being filled lie `stride` apart. Chaos has no smooth numbers: none are filled in. Inside chaos lie
//   many narrow periodic windows. A cell that is filled on a coarse lattice decides about its whole block, so
//   the rule is stricter there.
// If cells have attractors (attractors/), all around must have the same ones, distinguished by their labels,
// with smooth forces and shares; a share comes in steps of one start. The same holds for the outcomes of
// uncertain rigs, whose quantiles must be smooth inside chaos, too.
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

// The error of linear interpolation between such neighbours is a quarter of this share, of bicubic far less.
inline constexpr double smoothness = 0.01;

// Those that the job stores and that belong to the steady state, not to the transient, which a filled cell
// lacks.
[[nodiscard]] std::vector<const cell::Quantity*> interpolated_quantities(const job::Job& job);

// The cells at a stencil's rows and columns, which must all be set and outlive this object.
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

    [[nodiscard]] const std::vector<attractors::CellOutcome>& outcomes_at(std::size_t row,
                                                                          std::size_t column) const {
        return cells_[row][column]->outcomes;
    }

  private:
    const Stencil& rows_;
    const Stencil& columns_;
    std::int64_t stride_;
    std::array<std::array<const attractors::SolvedCell*, 4>, 4> cells_{};
};

// Nothing if some cells have a value and others none, or if the values are not smooth: if one deviates from its
// neighbours by more than `rough` or, if larger, `smoothness` of the largest. NaN if no cell has a value.
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

// Tries of each cell: starts besides [start], and rigs drawn.
struct Tries {
    std::int64_t starts = 0;
    std::int64_t rigs = 0;
};

// The cell, or nothing if it must be computed.
[[nodiscard]] std::optional<attractors::SolvedCell> filled(
    const Surroundings& around, std::span<const cell::Quantity* const> interpolated_ones,
    const Tries& tries = {});

}  // namespace peterka::refine
