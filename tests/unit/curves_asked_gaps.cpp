#include "curves/asked_gaps.hpp"

#include <gtest/gtest.h>

#include "map_examples.hpp"

namespace peterka::curves {
namespace {

// 0.89 mm are gap/A0 = 1; the default axes are frequency_ratio and gap_ratio.
TEST(AskedGaps, AreRatiosInEitherUnit) {
    job::Job job = map_file::examples::small_map(5, 5);
    job.kind = job::Kind::curves;
    EXPECT_EQ(gap_axis(job), 1U);
    job.curves.gap_ratio = {0.5, 2.0};
    const std::vector<double> ratios = asked_gaps(Rig(job), job);
    ASSERT_EQ(ratios.size(), 2U);
    EXPECT_DOUBLE_EQ(ratios[0], 0.5);
    EXPECT_DOUBLE_EQ(ratios[1], 2.0);
    job.curves.gap_ratio = {};
    job.curves.gap_m = {0.89e-3 / 2, 2 * 0.89e-3};
    const std::vector<double> lengths = asked_gaps(Rig(job), job);
    ASSERT_EQ(lengths.size(), 2U);
    EXPECT_DOUBLE_EQ(lengths[0], 0.5);
    EXPECT_DOUBLE_EQ(lengths[1], 2.0);
}

TEST(AskedGaps, ACoordinateIsOfItsAxis) {
    EXPECT_EQ(coordinate({3, 4}, 0), 3);
    EXPECT_EQ(coordinate({3, 4}, 1), 4);
    EXPECT_EQ(moved({3, 4}, 0, 2).column, 5);
    EXPECT_EQ(moved({3, 4}, 1, 2).row, 6);
}

}  // namespace
}  // namespace peterka::curves
