// Whether a cell can be filled from the cells around it instead of being computed, and with what.
//
// Around it are the cells of its stencils' rows and columns on the coarser lattice, 16 inside a block. It is
// filled
// - with their regime and z where all have the same, and every number it is to be filled with is smooth: of
// three
//   neighbours in a row or column, the one in the middle differs from the mean of the others (or from the line
//   through them) by at most `smoothness` of the largest number. It takes the bicubically interpolated one.
// - as chaotic where the cells next to it are, and all but a share of 0.3/stride, where the cells being filled
//   lie `stride` apart. Chaos has no smooth numbers: it takes none. Inside chaos lie many narrow periodic
//   windows. A cell that is filled on a coarse lattice decides about its whole block, so the rule is stricter
//   there.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "job/job.hpp"
#include "refine/lattice.hpp"
#include "regime/cell_result.hpp"

namespace peterka::refine {

// Linear interpolation between such neighbours is off by a quarter of this share, bicubic by far less.
inline constexpr double smoothness = 0.01;

// A number of a cell that can be interpolated.
using Number = double regime::CellResult::*;

// Those that the job stores and that belong to the steady state, not to the run towards it: a filled cell has
// none.
[[nodiscard]] std::vector<Number> interpolated_numbers(const job::Job& job);

// The cells at a stencil's rows and columns, which must all be set, and outlive this.
class Surroundings {
  public:
    // stride: of the lattice that the cell in question lies on.
    Surroundings(const Stencil& rows, const Stencil& columns, std::int64_t stride)
        : rows_(rows), columns_(columns), stride_(stride) {}

    void set(std::size_t row, std::size_t column, const regime::CellResult& cell) {
        cells_[row][column] = &cell;
    }

    [[nodiscard]] const Stencil& rows() const { return rows_; }
    [[nodiscard]] const Stencil& columns() const { return columns_; }
    [[nodiscard]] std::int64_t stride() const { return stride_; }
    [[nodiscard]] const regime::CellResult& at(std::size_t row, std::size_t column) const {
        return *cells_[row][column];
    }

  private:
    const Stencil& rows_;
    const Stencil& columns_;
    std::int64_t stride_;
    std::array<std::array<const regime::CellResult*, 4>, 4> cells_{};
};

// The cell, or nothing where it must be computed.
[[nodiscard]] std::optional<regime::CellResult> filled(const Surroundings& around,
                                                       std::span<const Number> numbers);

}  // namespace peterka::refine
