// Every row of tests/data/cells.csv: steady states from an independent program in extended precision.
#include "reference_cells.hpp"

#include <gtest/gtest.h>

namespace peterka::regime {
namespace {

using testing::ReferenceCell;

TEST(ReferenceCells, AreReproduced) {
    const auto cells = testing::read_cells();
    ASSERT_EQ(cells.size(), 66U);
    for (const ReferenceCell& cell : cells) {
        SCOPED_TRACE(cell.name);
        const CellResult result = find_steady_state(cell.oscillator, cell.start, {});
        EXPECT_EQ(result.impacts, cell.impacts);
        EXPECT_EQ(result.period, cell.period);
        EXPECT_EQ(result.status, Status::verified);
        EXPECT_NEAR(result.peak_force * cell.force_ratio_per_unit, cell.peak_force_ratio,
                    1e-10 * cell.peak_force_ratio);
    }
}

}  // namespace
}  // namespace peterka::regime
