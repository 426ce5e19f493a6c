#include "scene/rigs.hpp"

namespace peterka::scene {

// Each number is monotonic along an axis: what differs between two cells of a line differs between its ends.
Rigs rigs_of(const Scene& scene) {
    if (!scene.rigs_differ()) return Rigs::one;
    const std::int64_t last_row = scene.rows() - 1;
    const std::int64_t last_column = scene.columns() - 1;
    const auto same = [&](std::int64_t row, std::int64_t column, std::int64_t other_row,
                          std::int64_t other_column) {
        return same_rig(scene.cell(row, column).oscillator, scene.cell(other_row, other_column).oscillator);
    };
    const bool rows_share = same(0, 0, 0, last_column) && same(last_row, 0, last_row, last_column);
    const bool columns_share = same(0, 0, last_row, 0) && same(0, last_column, last_row, last_column);
    return rows_share || columns_share ? Rigs::of_lines : Rigs::of_cells;
}

}  // namespace peterka::scene
