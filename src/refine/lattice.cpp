#include "refine/lattice.hpp"

namespace peterka::refine {
namespace {

Stencil on_line(const Lattice& lattice, std::int64_t line) {
    Stencil stencil;
    for (std::int64_t i = std::max<std::int64_t>(line - 1, 0); i <= std::min(line + 1, lattice.lines() - 1);
         ++i) {
        stencil.positions[stencil.size] = lattice.position(i);
        stencil.weights[stencil.size] = i == line ? 1 : 0;
        if (i == line) stencil.before = stencil.after = stencil.size;
        ++stencil.size;
    }
    return stencil;
}

// Weight in Lagrange interpolation.
double weight(const Stencil& stencil, std::size_t own, std::int64_t at) {
    double product = 1;
    for (std::size_t i = 0; i < stencil.size; ++i) {
        if (i == own) continue;
        product *= static_cast<double>(at - stencil.positions[i]) /
                   static_cast<double>(stencil.positions[own] - stencil.positions[i]);
    }
    return product;
}

Stencil between_lines(const Lattice& lattice, std::int64_t before, std::int64_t at) {
    const std::int64_t lines = lattice.lines();
    const std::int64_t first = std::clamp<std::int64_t>(before - 1, 0, std::max<std::int64_t>(lines - 4, 0));
    Stencil stencil;
    stencil.size = static_cast<std::size_t>(std::min<std::int64_t>(lines, 4));
    for (std::size_t i = 0; i < stencil.size; ++i) {
        stencil.positions[i] = lattice.position(first + static_cast<std::int64_t>(i));
    }
    for (std::size_t i = 0; i < stencil.size; ++i) stencil.weights[i] = weight(stencil, i, at);
    stencil.before = static_cast<std::size_t>(before - first);
    stencil.after = stencil.before + 1;
    return stencil;
}

}  // namespace

Stencil stencil_of(const Lattice& lattice, std::int64_t position) {
    const std::int64_t line = lattice.line_before(position);
    return lattice.has(position) ? on_line(lattice, line) : between_lines(lattice, line, position);
}

// At an edge of the grid the stencil of a position between two lines reaches further than that of a line before
// it.
Interval reach_of(const Lattice& lattice, Interval interval) {
    Interval reach = interval;
    for (const std::int64_t at : {interval.first, std::min(interval.first + 1, interval.last),
                                  std::max(interval.last - 1, interval.first), interval.last}) {
        const Stencil stencil = stencil_of(lattice, at);
        reach.first = std::min(reach.first, stencil.positions.front());
        reach.last = std::max(reach.last, stencil.positions[stencil.size - 1]);
    }
    return reach;
}

}  // namespace peterka::refine
