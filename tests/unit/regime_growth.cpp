#include "regime/growth.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace peterka::regime {
namespace {

TEST(Growth, FindsTheExponentOfAConstantStretch) {
    Growth growth;
    Eigen::Matrix2d stretch;
    stretch << 1.1, 0.3, 0.0, 0.5;
    for (int n = 0; n < 1000; ++n) growth.advance(stretch);
    EXPECT_NEAR(growth.exponent(), std::log(1.1), 1e-12);
    EXPECT_TRUE(growth.surely_positive());
    EXPECT_NEAR(growth.sensitivity(), 1000 * std::log(1.1), 1.0);
}

TEST(Growth, IsNotSureOfAnExponentNearZero) {
    Growth growth;
    std::mt19937 random(3);
    std::normal_distribution<double> rate(0.0, 0.5);
    for (int n = 0; n < 3000; ++n) growth.advance(std::exp(rate(random)) * Eigen::Matrix2d::Identity());
    EXPECT_FALSE(growth.surely_positive());
}

// 1000 cycles of a steady drift that amplifies a perturbation only threefold.
TEST(Growth, DoesNotTakeASlowDriftForChaos) {
    Growth growth;
    for (int n = 0; n < 1000; ++n) growth.advance(std::exp(0.001) * Eigen::Matrix2d::Identity());
    EXPECT_NEAR(growth.exponent(), 0.001, 1e-12);
    EXPECT_FALSE(growth.surely_positive());
}

TEST(Growth, RemembersTheLargestGrowth) {
    Growth growth;
    for (int n = 0; n < 10; ++n) growth.advance(2 * Eigen::Matrix2d::Identity());
    for (int n = 0; n < 500; ++n) growth.advance(0.5 * Eigen::Matrix2d::Identity());
    // contributions of the ten cycles add up: (4^11 - 1)/3 in squares
    EXPECT_NEAR(growth.sensitivity(), std::log((std::pow(4, 11) - 1) / 3) / 2, 1e-12);
    EXPECT_FALSE(growth.surely_positive());
}

// A contact that erases all memory of the start does not end rounding: later errors grow.
TEST(Growth, CountsErrorsThatComeInLate) {
    Growth growth;
    Eigen::Matrix2d forgets;
    forgets << 1e-9, 0, 0, 1e-9;
    for (int n = 0; n < 20; ++n) growth.advance(forgets);
    for (int n = 0; n < 40; ++n) growth.advance(2 * Eigen::Matrix2d::Identity());
    EXPECT_GT(growth.sensitivity(), 40 * std::log(2.0));
    EXPECT_LT(growth.sensitivity(), 40 * std::log(2.0) + 0.5);
}

TEST(Growth, StaysFiniteHoweverFarErrorsGrowOrShrink) {
    Growth growth;
    for (int n = 0; n < 3000; ++n) growth.advance(10 * Eigen::Matrix2d::Identity());
    EXPECT_NEAR(growth.sensitivity(), 3000 * std::log(10.0), 1);
    for (int n = 0; n < 6000; ++n) growth.advance(0.1 * Eigen::Matrix2d::Identity());
    for (int n = 0; n < 100; ++n) growth.advance(10 * Eigen::Matrix2d::Identity());
    EXPECT_NEAR(growth.sensitivity(), 3000 * std::log(10.0), 1);
}

TEST(Growth, TellsHowFastAreasShrink) {
    Growth growth;
    Eigen::Matrix2d stretch;
    stretch << 3, 1, 0, 0.2;
    for (int n = 0; n < 2000; ++n) growth.advance(stretch);
    EXPECT_NEAR(growth.dissipation(), -std::log(0.6), 1e-12);
}

TEST(Growth, SurvivesASingularMap) {
    Growth growth;
    for (int n = 0; n < 300; ++n) growth.advance(Eigen::Matrix2d::Zero());
    EXPECT_FALSE(growth.surely_positive());
    EXPECT_LT(growth.sensitivity(), 1e-12);
}

}  // namespace
}  // namespace peterka::regime
