#include "refine/region.hpp"

#include <optional>

namespace peterka::refine {
namespace {

using attractors::SolvedCell;

std::int64_t size_of(Interval interval) {
    return interval.last - interval.first + 1;
}

Lattice lattice_of(std::int64_t points, std::size_t level) {
    return {points, std::int64_t{1} << level};
}

std::vector<std::int64_t> positions_in(const Lattice& lattice, Interval interval) {
    std::vector<std::int64_t> positions;
    const std::int64_t last = lattice.line_before(interval.last);
    for (std::int64_t line = lattice.line_before(interval.first); line <= last; ++line) {
        positions.push_back(lattice.position(line));
    }
    return positions;
}

struct Line {
    std::int64_t position = 0;
    bool on_coarser = false;
    Stencil stencil;
};

std::vector<Line> lines_in(std::int64_t points, std::size_t level, Interval interval) {
    const Lattice coarser = lattice_of(points, level + 1);
    std::vector<Line> lines;
    for (const std::int64_t position : positions_in(lattice_of(points, level), interval)) {
        lines.push_back({position, coarser.has(position), stencil_of(coarser, position)});
    }
    return lines;
}

std::size_t size_of_cell(const job::Job& job) {
    const std::int64_t kept = job.starts.count > 0 ? job.starts.attractors : 0;
    const std::int64_t outcomes = job.uncertainty.rigs > 0 ? cell::kept_outcomes : 0;
    return sizeof(SolvedCell) + static_cast<std::size_t>(kept) * sizeof(attractors::CellAttractor) +
           static_cast<std::size_t>(outcomes) * sizeof(attractors::CellOutcome);
}

}  // namespace

Region::Region(const job::Job& job, const parallel::Tile& rectangle)
    : grid_{job.rows.points, job.columns.points},
      interpolated_(interpolated_quantities(job)),
      tries_{job.starts.count, job.uncertainty.rigs},
      needed_(needed_for(job, rectangle)),
      levels_to_do_(needed_.size()),
      cells_(needed_.back().cells()) {}

std::size_t Region::Rectangle::cells() const {
    return static_cast<std::size_t>(size_of(rows) * size_of(columns));
}

std::vector<Region::Rectangle> Region::needed_for(const job::Job& job, const parallel::Tile& rectangle) {
    std::vector<Rectangle> needed{{{rectangle.row, rectangle.row + rectangle.extent.rows - 1},
                                   {rectangle.column, rectangle.column + rectangle.extent.columns - 1}}};
    for (std::size_t level = 1; level <= static_cast<std::size_t>(job.refine.levels); ++level) {
        needed.push_back({reach_of(lattice_of(job.rows.points, level), needed.back().rows),
                          reach_of(lattice_of(job.columns.points, level), needed.back().columns)});
    }
    return needed;
}

std::int64_t Region::bytes(const job::Job& job, const parallel::Tile& rectangle) {
    return static_cast<std::int64_t>(needed_for(job, rectangle).back().cells() * size_of_cell(job));
}

std::vector<parallel::CellIndex> Region::next() {
    to_compute_.clear();
    while (to_compute_.empty() && levels_to_do_ > 0) {
        const std::size_t level = --levels_to_do_;
        if (level + 1 == needed_.size()) {
            take_all(level);
        } else {
            refine(level);
        }
    }
    return to_compute_;
}

void Region::put(std::span<const SolvedCell> results) {
    for (std::size_t i = 0; i < results.size(); ++i) {
        cells_[index(to_compute_[i].row, to_compute_[i].column)] = results[i];
    }
}

std::vector<SolvedCell> Region::cells(const parallel::Tile& tile) const {
    std::vector<SolvedCell> cells;
    for (std::int64_t row = tile.row; row < tile.row + tile.extent.rows; ++row) {
        const SolvedCell* first = &cells_[index(row, tile.column)];
        cells.insert(cells.end(), first, first + tile.extent.columns);
    }
    return cells;
}

void Region::take_all(std::size_t level) {
    const auto columns = positions_in(lattice_of(grid_.columns, level), needed_[level].columns);
    for (const std::int64_t row : positions_in(lattice_of(grid_.rows, level), needed_[level].rows)) {
        for (const std::int64_t column : columns) to_compute_.push_back({row, column});
    }
}

// Fills what can be filled of a lattice's cells that the next coarser one lacks; the others must be computed.
void Region::refine(std::size_t level) {
    const std::int64_t stride = std::int64_t{1} << level;
    const std::vector<Line> columns = lines_in(grid_.columns, level, needed_[level].columns);
    for (const Line& row : lines_in(grid_.rows, level, needed_[level].rows)) {
        for (const Line& column : columns) {
            if (row.on_coarser && column.on_coarser) continue;
            Surroundings around(row.stencil, column.stencil, stride);
            for (std::size_t i = 0; i < row.stencil.size; ++i) {
                for (std::size_t j = 0; j < column.stencil.size; ++j) {
                    around.set(i, j, cells_[index(row.stencil.positions[i], column.stencil.positions[j])]);
                }
            }
            const std::optional<SolvedCell> cell = filled(around, interpolated_, tries_);
            if (cell) {
                cells_[index(row.position, column.position)] = *cell;
            } else {
                to_compute_.push_back({row.position, column.position});
            }
        }
    }
}

std::size_t Region::index(std::int64_t row, std::int64_t column) const {
    const Rectangle& largest = needed_.back();
    return static_cast<std::size_t>((row - largest.rows.first) * size_of(largest.columns) + column -
                                    largest.columns.first);
}

}  // namespace peterka::refine
