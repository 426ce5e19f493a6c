// The law of the rigid stop: preload, release, and the end of chatter, against formulas and brute force.
#include "trajectory/rigid_stop.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "rigid_rig.hpp"

namespace peterka::trajectory {
namespace {

using testing::rigid;

constexpr double pi = std::numbers::pi;

TEST(RigidStop, PressesWhereTheCartBeatsTheSpring) {
    const auto oscillator = rigid(0.6, 2.0, 1.0);  // 4 sin(theta) > 1
    const RigidStop<double> stop(oscillator);
    const double rise = std::asin(0.25);
    EXPECT_FALSE(stop.presses(0));
    EXPECT_FALSE(stop.presses(rise - 1e-12));
    EXPECT_TRUE(stop.presses(rise));
    EXPECT_TRUE(stop.presses(pi - rise));
    EXPECT_FALSE(stop.presses(pi - rise + 1e-12));
    EXPECT_FALSE(stop.always_presses());
    EXPECT_NEAR(stop.ahead_to_release(pi / 2), pi / 2 - rise, 1e-15);
    EXPECT_NEAR(stop.ahead_to_release(pi), 2 * pi - rise, 1e-15);
    EXPECT_NEAR(stop.ahead_to_pressing(0), rise, 1e-15);
    EXPECT_NEAR(stop.ahead_to_pressing(pi / 2), 1.5 * pi + rise, 1e-14);
    EXPECT_DOUBLE_EQ(stop.ahead_to_pressing(rise), 2 * pi);
    EXPECT_EQ(stop.ahead_to_release(pi - rise), 0);
}

TEST(RigidStop, PressesAlwaysOrNever) {
    const RigidStop<double> far(rigid(0.6, 2.0, 4.0));
    EXPECT_FALSE(far.presses(pi / 2));
    EXPECT_EQ(far.ahead_to_pressing(0), std::numeric_limits<double>::infinity());
    const RigidStop<double> near(rigid(0.6, 2.0, -4.0));
    EXPECT_TRUE(near.always_presses());
    EXPECT_TRUE(near.presses(1.5 * pi));
    EXPECT_EQ(near.ahead_to_release(0), std::numeric_limits<double>::infinity());
    const RigidStop<double> nearly(rigid(0.6, 2.0, -3.999));
    EXPECT_FALSE(nearly.always_presses());
    EXPECT_FALSE(nearly.presses(1.5 * pi));
}

// All zeros of the acceleration, the cubic's in either form, by scanning.
TEST(RigidStop, FindsEveryReleaseOfACubicSpring) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> uniform(-1, 1);
    int releases = 0;
    for (int n = 0; n < 300; ++n) {
        auto oscillator = rigid(0.5, 1.2 + uniform(random), 2 * uniform(random));
        oscillator.cubic = 0.5 * uniform(random);
        oscillator.cubic_form = n % 2 == 0 ? job::CubicForm::absolute : job::CubicForm::relative;
        const RigidStop<double> stop(oscillator);
        const auto a = [&](double theta) {
            const double y = oscillator.cubic_form == job::CubicForm::absolute ? std::sin(theta) : 0;
            const double g = oscillator.gap;
            return oscillator.drive() * std::sin(theta) - g -
                   oscillator.cubic * (std::pow(g + y, 3) - y * y * y);
        };
        constexpr int steps = 20'000;
        for (int i = 0; i < steps; ++i) {
            const double from = 2 * pi * i / steps;
            const double to = 2 * pi * (i + 1) / steps;
            ASSERT_NEAR(stop.acceleration(from), a(from), 1e-13);
            const bool falls = a(from) > 0 && a(to) < 0;
            const bool rises = a(from) < 0 && a(to) > 0;
            ASSERT_EQ(stop.ahead_to_release(from) < to - from, falls) << n << " " << from;
            ASSERT_EQ(stop.ahead_to_pressing(from) < to - from, rises) << n << " " << from;
            if (std::abs(a(from)) > 1e-12) {
                ASSERT_EQ(stop.presses(from), a(from) > 0) << n << " " << from;
            }
            if (falls) {
                ++releases;
                EXPECT_NEAR(a(from + stop.ahead_to_release(from)), 0, 1e-13);
            }
        }
        // and the impulse of an interval
        double sum = 0;
        for (int i = 0; i < steps; ++i)
            sum += a(1 + 2.5 * (i + 0.5) / steps) * 2.5 / steps / oscillator.frequency;
        EXPECT_NEAR(stop.impulse(1, 3.5), sum, 1e-7);
        double largest = -1e300;
        for (int i = 0; i <= steps; ++i) largest = std::max(largest, a(1 + 2.5 * i / steps));
        EXPECT_NEAR(stop.largest(1, 3.5), largest, 1e-6);
        EXPECT_GE(stop.largest(1, 3.5), largest - 1e-13);
    }
    EXPECT_GT(releases, 100);
}

// Impact by impact in long double, the flights by the series of delta'' = a(t) - 2 zeta delta' - delta.
long double time_to_rest(const scene::Oscillator<double>& oscillator, long double theta, long double w) {
    const long double r = std::get<scene::Restitution<double>>(oscillator.contact).coefficient;
    const long double eta = oscillator.frequency;
    const long double zeta = oscillator.damping_ratio;
    long double time = 0;
    for (int n = 0; n < 100'000 && w > 1e-30L; ++n) {
        const long double sine = std::sin(theta + eta * time);
        const long double cosine = std::cos(theta + eta * time);
        // coefficients of delta(t) = sum c_n t^n
        std::array<long double, 12> c{0, -w};
        std::array<long double, 10> wave{};
        const std::array<long double, 4> cycle{sine, cosine, -sine, -cosine};
        long double factor = oscillator.drive();
        for (std::size_t k = 0; k < wave.size(); ++k) {
            wave[k] = factor * cycle[k % 4];
            factor *= eta / static_cast<long double>(k + 1);
        }
        wave[0] -= oscillator.gap;
        for (std::size_t k = 0; k < wave.size(); ++k) {
            const auto j = static_cast<long double>(k);
            c[k + 2] = (wave[k] - 2 * zeta * (j + 1) * c[k + 1] - c[k]) / ((j + 1) * (j + 2));
        }
        // delta(t)/t = 0 by Newton's method from the parabola's root
        long double t = w / c[2];
        long double velocity = 0;
        for (int step = 0; step < 60; ++step) {
            long double value = 0;
            long double slope = 0;
            for (std::size_t k = c.size() - 1; k >= 1; --k) {
                slope = slope * t + value;
                value = value * t + c[k];
            }
            const long double correction = value / slope;
            t -= correction;
            velocity = slope * t;  // delta' = (t delta/t)' = delta/t + t (delta/t)'
            if (std::abs(correction) < 1e-19L * t) break;
        }
        time += t;
        w = r * velocity;
    }
    return time;
}

struct Chatter {
    double restitution;
    double zeta;
    double theta;
    double share;  // of the largest speed from which the series is used
};

class ChatterTime : public ::testing::TestWithParam<Chatter> {};

TEST_P(ChatterTime, IsThatOfTheImpactsOneByOne) {
    const auto [r, zeta, theta, share] = GetParam();
    const auto oscillator = rigid(r, 1.7, 0.4, zeta);
    const RigidStop<double> stop(oscillator);
    double w = 1;
    while (!stop.time_to_rest(theta, w)) w *= 0.9;
    w *= share;
    const auto exact = static_cast<double>(time_to_rest(oscillator, theta, w));
    const double told = *stop.time_to_rest(theta, w);
    // the remainder is lost in the rounding of a time of order 1
    EXPECT_NEAR(told, exact, 2e-17);
    const double first_order = 2 * w / (stop.acceleration(theta) * (1 - r));
    EXPECT_GT(std::abs(first_order - exact), 20 * std::abs(told - exact)) << "the correction is worth nothing";
}

INSTANTIATE_TEST_SUITE_P(Laws, ChatterTime,
                         ::testing::Values(Chatter{0.1, 0.02, 1.0, 1}, Chatter{0.5, 0.02, 2.0, 1},
                                           Chatter{0.8, 0.3, 0.5, 1}, Chatter{0.95, 0.02, 2.5, 1},
                                           Chatter{0.99, 1.5, 1.0, 1}, Chatter{0.6, 0, 2.8, 1}));

// For a constant acceleration the formula 2 w/(a (1 - r)) is exact: a cart so slow that it stands still.
TEST(ChatterTimeOfAConstantAcceleration, IsTheFormula) {
    const RigidStop<double> stop(rigid(0.7, 1e-9, -2.0, 0));
    for (const double w : {4e-7, 1e-7, 1e-9}) {
        ASSERT_TRUE(stop.time_to_rest(1.0, w)) << w;
        EXPECT_NEAR(*stop.time_to_rest(1.0, w) / (2 * w / (2.0 * (1 - 0.7))), 1, 1e-15);
    }
}

TEST(ChatterTimeOfAnElasticStop, DoesNotExist) {
    const RigidStop<double> stop(rigid(1, 1.7, 0.4));
    EXPECT_FALSE(stop.time_to_rest(1.0, 1e-12));
    EXPECT_EQ(RigidStop<double>(rigid(0, 1.7, 0.4)).time_to_rest(1.0, 0.0), 0.0);
}

}  // namespace
}  // namespace peterka::trajectory
