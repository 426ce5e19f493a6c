#include "curves/placed_rig.hpp"

#include <gtest/gtest.h>

#include "rig.hpp"

namespace peterka::curves {
namespace {

TEST(PlacedRig, FollowsTheChainRule) {
    const PlaceSlopes slopes{
        .frequency_by_column = 2, .gap_by_column = 3, .frequency_by_row = 5, .gap_by_row = 7};
    const PlacedRig rig(testing::paper_rig(testing::beam_170mm, 2, 0.5), slopes);
    EXPECT_EQ(rig.by_column(10.0, 100.0), 2 * 10 + 3 * 100);
    EXPECT_EQ(rig.by_row(10.0, 100.0), 5 * 10 + 7 * 100);
    const PlacedRig in_ratios(testing::paper_rig(testing::beam_170mm, 2, 0.5));
    EXPECT_EQ(in_ratios.by_column(10.0, 100.0), 10);
    EXPECT_EQ(in_ratios.by_row(10.0, 100.0), 100);
}

TEST(PlacedRig, HasLinearSprings) {
    scene::Oscillator<double> bent = testing::paper_rig(testing::beam_170mm, 2, 0.5);
    bent.cubic = 0.3;
    EXPECT_EQ(PlacedRig(bent).oscillator().cubic, 0);
}

}  // namespace
}  // namespace peterka::curves
