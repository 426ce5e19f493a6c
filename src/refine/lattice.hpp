// The coarser grids inside a grid of cells, one axis at a time: pure arithmetic.
//
// A lattice of stride s has every s-th position of an axis and the last one, so that nothing lies outside it. A
// stencil is what surrounds a position on a lattice: the lines next to it and one more on either side.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace peterka::refine {

class Lattice {
  public:
    Lattice(std::int64_t points, std::int64_t stride) : last_(points - 1), stride_(stride) {}

    [[nodiscard]] std::int64_t lines() const { return (last_ + stride_ - 1) / stride_ + 1; }
    [[nodiscard]] std::int64_t position(std::int64_t line) const { return std::min(line * stride_, last_); }
    [[nodiscard]] bool has(std::int64_t position) const { return position % stride_ == 0 || position == last_; }
    // The last line at or before a position.
    [[nodiscard]] std::int64_t line_before(std::int64_t position) const {
        return position == last_ ? lines() - 1 : position / stride_;
    }

  private:
    std::int64_t last_;
    std::int64_t stride_;
};

struct Stencil {
    std::array<std::int64_t, 4> positions{};  // ascending
    std::array<double, 4> weights{};          // of polynomial interpolation through all lines
    std::size_t size = 0;
    std::size_t before = 0;  // the lines next to the position; both are its own if it lies on one
    std::size_t after = 0;
};

// On a line: that line, with weight 1, and its neighbours. Between two lines: four lines, shifted inwards at an
// edge of the grid, and fewer only if the lattice has fewer.
[[nodiscard]] Stencil stencil_of(const Lattice& lattice, std::int64_t position);

// Positions first ... last.
struct Interval {
    std::int64_t first = 0;
    std::int64_t last = 0;
};

// The stencils of all positions of an interval lie in this one.
[[nodiscard]] Interval reach_of(const Lattice& lattice, Interval interval);

}  // namespace peterka::refine
