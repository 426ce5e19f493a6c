// The mean lifetime of transient chaos, from randomly censored lifetimes.
#include "attractors/mean_life.hpp"

#include <gtest/gtest.h>

#include <random>

namespace peterka::attractors {
namespace {

using regime::CellResult;
using regime::Regime;

CellResult start(Regime regime, std::int32_t forgot_after, std::int32_t followed,
                 std::int32_t last_impact = -1) {
    CellResult result;
    result.regime = regime;
    result.forgot_after = forgot_after;
    result.followed_cycles = followed;
    result.last_impact = last_impact;
    return result;
}

TEST(MeanLife, IsTheTimeOnTheChaosOverTheEscapes) {
    MeanLife life;
    life.take(start(Regime::chaotic, 80, 1080));
    life.take(start(Regime::no_impact, 50, 700, 350));  // 300 until its last impact
    life.take(start(Regime::periodic, 100, 800));
    life.take(start(Regime::unresolved, 100, 300));
    life.take(start(Regime::no_impact, 0, 40, 30));   // never forgot its start
    life.take(start(Regime::no_impact, 60, 90, 55));  // forgot its start after the last impact
    EXPECT_EQ(life.mean(), (1000 + 300 + 700 + 200) / 2.0);
    EXPECT_DOUBLE_EQ(life.error(), life.mean() / std::sqrt(2.0));
}

// Out of the range of numbers, by softening springs; a solver that fails tells nothing of what comes next.
TEST(MeanLife, EndsWhereTheHammerIsThrownOut) {
    MeanLife life;
    CellResult thrown_out = start(Regime::failed, 80, 580);
    thrown_out.status = cell::Status::not_finite;
    CellResult stuck = start(Regime::failed, 80, 380);
    stuck.status = cell::Status::solver_failed;
    life.take(thrown_out);
    EXPECT_EQ(life.mean(), 500);
    life.take(stuck);
    EXPECT_EQ(life.mean(), 800);
}

TEST(MeanLife, IsUnknownWhereNoneEscapes) {
    MeanLife life;
    life.take(start(Regime::chaotic, 80, 1080));
    EXPECT_TRUE(std::isnan(life.mean()));
    EXPECT_TRUE(std::isnan(life.error()));
}

// Random lifetimes censored at 1000 cycles: the estimated error covers the deviation of the mean.
TEST(MeanLife, IsThatOfLivesThatAreCutOff) {
    constexpr double mean = 2000;
    std::mt19937_64 random(1);
    std::exponential_distribution<double> lives(1 / mean);
    double square = 0;
    constexpr int times = 200;
    for (int i = 0; i < times; ++i) {
        MeanLife life;
        for (int n = 0; n < 400; ++n) {
            const double lived = lives(random);
            life.take(lived < 1000
                          ? start(Regime::no_impact, 50, 2000, 50 + static_cast<std::int32_t>(lived) + 1)
                          : start(Regime::chaotic, 50, 1050));
        }
        square += std::pow((life.mean() - mean) / life.error(), 2) / times;
    }
    EXPECT_GT(square, 0.7);
    EXPECT_LT(square, 1.4);
}

}  // namespace
}  // namespace peterka::attractors
