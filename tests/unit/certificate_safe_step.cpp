// The largest safe step against the parabola itself in extended precision.
#include "certificate/safe_step.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace peterka::certificate {
namespace {

// Slopes far larger and far smaller than what they are added to, of either sign.
TEST(SafeStep, EndsWhereTheParabolaIsZeroWhateverTheSlope) {
    for (const double value : {-3.0, -1e-8, -1e-20}) {
        for (const double slope : {-2.0, -0.5, 0.0, 1e-6, 0.3, 0.9, 1.0, 7.0}) {
            for (const double bend : {0.25, 1.0, 40.0}) {
                const long double h = safe_step(value, slope, bend);
                const auto parabola = [&](long double t) { return value + slope * t + bend * t * t / 2; };
                EXPECT_LT(parabola(h * (1 - 1e-14L)), 0) << value << " " << slope << " " << bend;
                EXPECT_GT(parabola(h * (1 + 1e-14L)), 0) << value << " " << slope << " " << bend;
            }
        }
    }
}

TEST(SafeStep, FromZeroIsLongOnlyWhereItFalls) {
    EXPECT_EQ(safe_step(0, -1, 4), 0.5);
    EXPECT_EQ(safe_step(0, 0, 4), 0);
    EXPECT_EQ(safe_step(0, 1, 4), 0);
}

TEST(SafeStep, FromAboveThereIsNone) {
    EXPECT_EQ(safe_step(1e-300, -1, 1), 0);
    EXPECT_EQ(safe_step(std::nan(""), -1, 1), 0);
}

}  // namespace
}  // namespace peterka::certificate
