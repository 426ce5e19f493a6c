// Balls enclose what intervals of doubles enclose, more closely; their bounds as doubles are outward.
#include "certificate/ball.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace peterka::certificate {
namespace {

bool overlap(const Ball& ball, const Interval& x) {
    return ball.lowest() <= x.hi && x.lo <= ball.highest();
}

TEST(Ball, FunctionsAgreeWithIntervalsAndAreMuchNarrower) {
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> of(-9, 9);
    for (int n = 0; n < 2000; ++n) {
        const double a = of(random);
        const double b = of(random);
        const SineCosineOf<Ball> angle = sine_cosine(Ball(a));
        const SineCosine enclosed = sine_cosine(Interval(a));
        for (const auto& [ball, interval] : {std::pair(Ball(a) + Ball(b), Interval(a) + Interval(b)),
                                             {Ball(a) - Ball(b), Interval(a) - Interval(b)},
                                             {Ball(a) * Ball(b), Interval(a) * Interval(b)},
                                             {Ball(a) / Ball(b), Interval(a) / Interval(b)},
                                             {exp(Ball(a)), exp(Interval(a))},
                                             {sqrt(abs(Ball(a))), sqrt(abs(Interval(a)))},
                                             {square(Ball(a)), square(Interval(a))},
                                             {-Ball(a), -Interval(a)},
                                             {angle.sine, enclosed.sine},
                                             {angle.cosine, enclosed.cosine}}) {
            ASSERT_TRUE(overlap(ball, interval)) << a << ' ' << b;
            ASSERT_LE(ball.radius(), 1e-120 * ball.size()) << a << ' ' << b;
        }
    }
    EXPECT_TRUE(overlap(Constants<Ball>::pi(), pi));
}

TEST(Ball, BoundsAreOutward) {
    const Ball third = Ball(1) / Ball(3);
    EXPECT_LT(third.lowest(), third.highest());  // no double is a third
    EXPECT_EQ(std::nextafter(third.lowest(), 1), third.highest());
    EXPECT_EQ((-third).size(), third.highest());
    EXPECT_TRUE(third.hull().holds(1.0 / 3));
    EXPECT_EQ(third.middle().radius(), 0);
    const Ball wide(Interval(1, 2));
    EXPECT_LE(wide.lowest(), 1);
    EXPECT_GE(wide.highest(), 2);
    EXPECT_GE(spread_of(wide, point_of(wide)), 0.5);
    EXPECT_GE(box_around(Ball(1), 0.25).highest(), 1.25);
    EXPECT_LE(plus_minus(0.5, Ball(3)).lowest(), -0.5);
    EXPECT_GE(span_of(Ball(1), 0.5).highest(), 1.5);
    EXPECT_FALSE(Ball(Interval(-1e-300, 1)).positive());
    EXPECT_TRUE(surely_positive(third));
}

TEST(Ball, WhatIsNoNumberProvesNothing) {
    for (const Ball& none : {Ball(nothing()), Ball(1) / Ball(Interval(-1, 1)), sqrt(Ball(-1))}) {
        EXPECT_FALSE(none.positive());
        EXPECT_FALSE(std::isfinite(none.size()));
        EXPECT_TRUE(std::isnan(none.hull().lo));
    }
}

TEST(Ball, TheCommonPartIsInBothOrThereIsNone) {
    const auto common = common_part(Ball(Interval(0, 2)), Ball(Interval(1, 3)));
    ASSERT_TRUE(common);
    EXPECT_NEAR(common->lowest(), 1, 1e-8);
    EXPECT_NEAR(common->highest(), 2, 1e-8);
    EXPECT_FALSE(common_part(Ball(0), Ball(1)));
}

}  // namespace
}  // namespace peterka::certificate
