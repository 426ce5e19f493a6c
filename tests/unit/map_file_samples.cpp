#include "map_file/samples.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace peterka::map_file {
namespace {

TEST(Samples, LieByVariablePointAndSampleAndArePaddedWithNan) {
    constexpr double gap = 0.5;
    std::vector<regime::BranchPoint> points(2, {{}, regime::SteadyMotion(3), gap});
    points[1].motion.stroboscopic.add({-1.5, 2.0});
    points[1].motion.stroboscopic.add({-2.5, 3.0});
    points[0].motion.touches.add({std::numbers::pi / 2, 4.0});
    points[1].motion.touches.add({-std::numbers::pi / 2, 5.0});
    const std::vector<double> values = sample_values(points, 3);
    ASSERT_EQ(values.size(), 4U * 2 * 3);
    const auto at = [&](int variable, int point, int sample) {
        return values[static_cast<std::size_t>((variable * 2 + point) * 3 + sample)];
    };
    EXPECT_EQ(at(0, 1, 0), -1.0);  // delta + gap
    EXPECT_EQ(at(0, 1, 1), -2.0);
    EXPECT_EQ(at(1, 1, 0), 2.0);
    EXPECT_EQ(at(1, 1, 1), 3.0);
    EXPECT_EQ(at(2, 0, 0), 1.5);  // gap + y
    EXPECT_EQ(at(3, 0, 0), 4.0);
    EXPECT_EQ(at(2, 1, 0), -0.5);
    EXPECT_EQ(at(3, 1, 0), 5.0);
    int numbers = 0;
    for (const double value : values) numbers += std::isnan(value) ? 0 : 1;
    EXPECT_EQ(numbers, 8);
}

}  // namespace
}  // namespace peterka::map_file
