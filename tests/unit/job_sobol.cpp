// Points of the low-discrepancy sequence and normal deviates, against values computed with scipy 1.10.1
// (scipy.stats.qmc.Sobol, which numbers points by Gray codes, and scipy.stats.norm.ppf).
#include "job/sobol.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>

#include "job/normal_quantile.hpp"

namespace peterka::job {
namespace {

struct Point {
    std::uint32_t n;
    std::array<std::uint32_t, sobol_dimensions> coordinates;
};
constexpr Point points[] = {
    {0, {}},
    {7,
     {3758096384, 3758096384, 536870912, 1610612736, 3758096384, 2684354560, 3758096384, 1610612736, 1610612736,
      536870912, 1610612736, 3758096384}},
    {49,
     {2348810240, 3288334336, 872415232, 201326592, 2751463424, 1811939328, 1275068416, 738197504, 2080374784,
      2348810240, 3825205248, 1946157056}},
    {32,
     {67108864, 3422552064, 1543503872, 1946157056, 3690987520, 603979776, 2483027968, 603979776, 3556769792,
      2483027968, 1811939328, 2885681152}},
};

TEST(Sobol, IsThatOfJoeAndKuo) {
    for (const Point& point : points) {
        for (std::size_t i = 0; i < sobol_dimensions; ++i)
            EXPECT_EQ(sobol(point.n, i), point.coordinates[i]) << point.n << " " << i;
    }
}

TEST(Sobol, HasAPointInEachInterval) {
    for (std::size_t i = 0; i < sobol_dimensions; ++i) {
        std::set<std::uint32_t> intervals;
        for (std::uint32_t n = 0; n < 256; ++n) intervals.insert(sobol(n, i) >> 24U);
        EXPECT_EQ(intervals.size(), 256U) << i;
    }
}

TEST(NormalQuantile, IsTheInverseOfTheDistributionFunction) {
    constexpr std::pair<double, double> values[] = {{1e-10, -6.361340902404056}, {1e-05, -4.264890793922825},
                                                    {0.01, -2.3263478740408408}, {0.075, -1.4395314709384563},
                                                    {0.3, -0.5244005127080409},  {0.5, 0.0},
                                                    {0.9, 1.2815515655446004},   {0.999, 3.090232306167813}};
    for (const auto& [probability, deviate] : values)
        EXPECT_NEAR(normal_quantile(probability), deviate, 1e-14 * std::abs(deviate)) << probability;
    for (double probability = 1e-15; probability < 1; probability *= 1.1) {
        const double back = std::erfc(-normal_quantile(probability) / std::sqrt(2.0)) / 2;
        EXPECT_NEAR(back / probability, 1, 1e-13) << probability;
    }
}

}  // namespace
}  // namespace peterka::job
