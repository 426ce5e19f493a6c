#include "support/random_numbers.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

namespace peterka {
namespace {

// Sebastiano Vigna's splitmix64.c, seed 1234567.
TEST(RandomNumbers, BitsAreThoseOfSplitMix64) {
    RandomNumbers random(1234567);
    EXPECT_EQ(random.bits(), 6457827717110365317U);
    EXPECT_EQ(random.bits(), 3203168211198807973U);
    EXPECT_EQ(random.bits(), 9817491932198370423U);
}

TEST(RandomNumbers, NormalNumbersHaveTheMomentsOfTheNormalDistribution) {
    RandomNumbers random(3);
    constexpr int count = 400'000;
    double sums[4] = {};
    int beyond = 0;
    double last = 0;
    double product = 0;
    for (int n = 0; n < count; ++n) {
        const double x = random.normal();
        for (int power = 0; power < 4; ++power) sums[power] += std::pow(x, power + 1);
        beyond += std::abs(x) > 3 ? 1 : 0;
        product += x * last;
        last = x;
    }
    const double error = 1 / std::sqrt(static_cast<double>(count));  // of the mean
    EXPECT_NEAR(sums[0] / count, 0, 4 * error);
    EXPECT_NEAR(sums[1] / count, 1, 4 * std::sqrt(2.0) * error);
    EXPECT_NEAR(sums[2] / count, 0, 4 * std::sqrt(15.0) * error);
    EXPECT_NEAR(sums[3] / count, 3, 4 * std::sqrt(96.0) * error);
    EXPECT_NEAR(beyond, 0.0026998 * count, 4 * std::sqrt(0.0027 * count));
    EXPECT_NEAR(product / count, 0, 4 * error);
}

TEST(RandomNumbers, OneOfSomeIsNeverBeyondThem) {
    RandomNumbers random(5);
    int seen[3] = {};
    for (int n = 0; n < 3000; ++n) ++seen[random.below(3)];
    for (const int times : seen) EXPECT_NEAR(times, 1000, 4 * std::sqrt(667.0));
}

}  // namespace
}  // namespace peterka
