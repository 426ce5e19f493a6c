// Event search: no hop is missed, however short, and no crossing is invented.
#include <gtest/gtest.h>

#include <cmath>

#include "trajectory/first_crossing.hpp"

namespace peterka::trajectory {
namespace {

using motion::LinearMotion;
using Ending = Crossing<double>::Ending;

// x = cos(t - 2) - level: touches zero at t = 2 when level is 1.
Crossing<double> search_cosine(double level, double end = 6.0) {
    const LinearMotion<double> motion({0, 1, -level, 0, 1});
    const Leg<double> leg(motion, {std::cos(2.0) - level, std::sin(2.0)}, 0);
    const Probe<double> probe({.position = 1}, motion);
    return first_crossing(leg, probe, leg.start(), end);
}

class GrazingHop : public ::testing::TestWithParam<double> {};

TEST_P(GrazingHop, IsFoundWhenItRises) {
    const double rise = GetParam();
    const auto search = search_cosine(1 - rise);
    ASSERT_EQ(search.ending, Ending::crossing);
    const double expected = 2 - 2 * std::asin(std::sqrt(rise / 2));
    EXPECT_NEAR(search.moment.time, expected, 4e-16 / std::sqrt(rise) + 2e-15);
}

TEST_P(GrazingHop, IsNotInventedWhenItStaysBelow) {
    EXPECT_EQ(search_cosine(1 + GetParam()).ending, Ending::none);
}

INSTANTIATE_TEST_SUITE_P(Heights, GrazingHop, ::testing::Values(1e-1, 1e-3, 1e-6, 1e-9, 1e-12));

TEST(FirstCrossing, TakesFewEvaluations) {
    EXPECT_LE(search_cosine(0.3).evaluations, 10);
    EXPECT_LE(search_cosine(1 - 1e-9).evaluations, 60);
}

TEST(FirstCrossing, StopsAtTheEndOfTheLeg) {
    const double crossing = 2 - std::acos(0.3);
    EXPECT_EQ(search_cosine(0.3, crossing - 1e-9).ending, Ending::none);
    EXPECT_EQ(search_cosine(0.3, crossing + 1e-9).ending, Ending::crossing);
}

TEST(FirstCrossing, LeavesAZeroAtTheStart) {
    const LinearMotion<double> motion({0.01, 1, 0, 0, 1});
    const Leg<double> leg(motion, {0, -1}, 0);  // moves down, and returns to zero after half a natural period
    const Probe<double> probe({.position = 1}, motion);
    const auto search = first_crossing(leg, probe, leg.start(), 6.0);
    ASSERT_EQ(search.ending, Ending::crossing);
    EXPECT_NEAR(search.moment.time, std::numbers::pi / std::sqrt(1 - 1e-4), 1e-14);
}

// The bound must hold at every later time, for each kind of damping; a violated bound loses events.
TEST(Probe, BoundsHoldEverAfter) {
    for (const double damping : {0.0, 0.01, 0.5, 0.98, 1.0, 1.02, 3.0, 50.0}) {
        for (const double frequency : {0.3, 1.0, 2.5}) {
            const LinearMotion<double> motion({damping, 1, -0.4, frequency * frequency, frequency});
            const Leg<double> leg(motion, {0.7, -2.0}, 0.3);
            const Probe<double> probe({.position = 3, .velocity = 0.8}, motion);
            const double cycle = 2 * std::numbers::pi / frequency;
            for (double from = 0; from < cycle; from += cycle / 16) {
                const auto bounds = probe.bounds(leg.at(from));
                double last = probe.curvature(leg.at(from));
                for (double t = from; t < cycle; t += cycle / 512) {
                    const double curvature = probe.curvature(leg.at(t));
                    ASSERT_LE(std::abs(curvature - last), bounds.jerk * cycle / 512 * (1 + 1e-9) + 1e-11);
                    last = curvature;
                    ASSERT_LE(std::abs(curvature), bounds.curvature * (1 + 1e-12))
                        << "damping " << damping << ", frequency " << frequency << ", from " << from << ", at "
                        << t;
                }
            }
        }
    }
}

}  // namespace
}  // namespace peterka::trajectory
