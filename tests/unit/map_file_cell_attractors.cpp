#include "map_file/cell_attractors.hpp"

#include <gtest/gtest.h>

namespace peterka::map_file {
namespace {

// The first slot of all cells, then the second; a cell has as many as it has.
TEST(CellAttractors, LieSlotBySlot) {
    std::vector<attractors::SolvedCell> cells(3);
    for (std::size_t cell = 0; cell < cells.size(); ++cell) {
        cells[cell].attractors.resize(cell);  // 0, 1, 2
        for (std::size_t slot = 0; slot < cell; ++slot)
            cells[cell].attractors[slot].share = 0.1 * static_cast<double>(10 * cell + slot);
    }
    const std::vector<scene::Scales> scales(3);
    const auto stored = stored_attractors(cells, 2, scales);
    ASSERT_EQ(stored.size(), 6U);
    EXPECT_DOUBLE_EQ(stored[1].share, 1.0);
    EXPECT_DOUBLE_EQ(stored[2].share, 2.0);
    EXPECT_DOUBLE_EQ(stored[5].share, 2.1);
    for (const std::size_t empty : {0U, 3U, 4U}) EXPECT_EQ(stored[empty].share, 0) << empty;
}

}  // namespace
}  // namespace peterka::map_file
