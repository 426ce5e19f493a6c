// Whether a cell can be filled from the cells around it instead of being computed, and with what.
//
// Around it are the cells of its stencils' rows and columns on the coarser lattice, 16 inside a block. It is
// filled
// - with their regime and z where all have the same, and every number it is to be filled with is smooth: of
// three
//   neighbours in a row or column, the one in the middle differs from the mean of the others (or from the line
//   through them) by at most `smoothness` of the largest number. It takes the bicubically interpolated one.
// - as chaotic where the cells next to it are, and four fifths of all. Chaos has no smooth numbers: it takes
//   none. Inside chaos lie many narrow periodic windows, and a laxer rule would hide more of them.
#pragma once

#include <array>
#include <cstddef>
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
    Surroundings(const Stencil& rows, const Stencil& columns) : rows_(rows), columns_(columns) {}

    void set(std::size_t row, std::size_t column, const regime::CellResult& cell) {
        cells_[row][column] = &cell;
    }

    [[nodiscard]] const Stencil& rows() const { return rows_; }
    [[nodiscard]] const Stencil& columns() const { return columns_; }
    [[nodiscard]] const regime::CellResult& at(std::size_t row, std::size_t column) const {
        return *cells_[row][column];
    }

  private:
    const Stencil& rows_;
    const Stencil& columns_;
    std::array<std::array<const regime::CellResult*, 4>, 4> cells_{};
};

// The cell, or nothing where it must be computed.
[[nodiscard]] std::optional<regime::CellResult> filled(const Surroundings& around,
                                                       std::span<const Number> numbers);

}  // namespace peterka::refine
