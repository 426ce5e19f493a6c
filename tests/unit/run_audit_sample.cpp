#include "run/audit_sample.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace peterka {
namespace {

TEST(AuditSample, TakesEachStretchOfCellsOnceAndInOrder) {
    for (const auto& [samples, cells] :
         {std::pair{200, 16'384}, std::pair{7, 20}, std::pair{1, 1}, std::pair{20, 20}}) {
        std::int64_t before = -1;
        for (std::int64_t index = 0; index < samples; ++index) {
            const std::int64_t cell = audited_cell(index, samples, cells);
            EXPECT_GT(cell, before);
            EXPECT_GE(cell, index * cells / samples);
            EXPECT_LT(cell, cells);
            before = cell;
        }
    }
}

TEST(AuditSample, OtherDrawsAreOtherCellsOfTheSameStretch) {
    int same = 0;
    for (std::int64_t index = 0; index < 100; ++index) {
        const std::int64_t first = audited_cell(index, 100, 100'000);
        for (std::int64_t draw = 1; draw < 8; ++draw) {
            const std::int64_t other = audited_cell(index, 100, 100'000, draw);
            EXPECT_EQ(other / 1000, index);
            same += other == first ? 1 : 0;
        }
    }
    EXPECT_LT(same, 10);
}

TEST(AuditSample, IsSpreadOverRowsAndColumns) {
    constexpr std::int64_t columns = 512;
    std::int64_t left = 0;
    for (std::int64_t index = 0; index < 1000; ++index) {
        left += audited_cell(index, 1000, columns * columns) % columns < columns / 2 ? 1 : 0;
    }
    EXPECT_NEAR(static_cast<double>(left), 500, 50);  // three standard deviations
}

TEST(AuditSample, HoldsOutOnTheLargestMap) {
    constexpr std::int64_t cells = std::numeric_limits<std::int64_t>::max();
    EXPECT_GT(audited_cell(999'999, 1'000'000, cells), cells / 1'000'000 * 999'998);
    EXPECT_LT(audited_cell(999'999, 1'000'000, cells), cells);
}

}  // namespace
}  // namespace peterka
