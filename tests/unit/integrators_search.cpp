// Events and largest values between two samples, of signals in closed form.
#include "integrators/search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <random>
#include <utility>

namespace peterka::integrators {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

using Coefficients = std::array<double, 6>;  // of Bernstein polynomials of degree 5

// The samples at both ends of [begin, begin + h] of the curve with these coefficients.
std::pair<Sample, Sample> ends_of(const Coefficients& c, double begin, double h) {
    return {{begin, c[0], 5 * (c[1] - c[0]) / h, 20 * (c[2] - 2 * c[1] + c[0]) / (h * h)},
            {begin + h, c[5], 5 * (c[5] - c[4]) / h, 20 * (c[5] - 2 * c[4] + c[3]) / (h * h)}};
}

SignalCurve curve_of(const Coefficients& c) {
    const auto [a, b] = ends_of(c, 2, 0.5);
    return {a, b};
}

TEST(SignalCurve, IsTheQuinticOfItsSamples) {
    const Coefficients c{1, -2, 0.5, 3, -1, 0.25};
    const SignalCurve curve = curve_of(c);
    for (std::size_t i = 0; i < c.size(); ++i) EXPECT_NEAR(curve.at[i], c[i], 1e-13);
    constexpr std::array binomial{1, 5, 10, 10, 5, 1};
    for (const double share : {0.0, 0.2, 0.5, 0.9, 1.0}) {
        const auto value = [&](double s) {
            double sum = 0;
            for (std::size_t i = 0; i < c.size(); ++i) {
                const auto k = static_cast<double>(i);
                sum += binomial[i] * c[i] * std::pow(s, k) * std::pow(1 - s, 5 - k);
            }
            return sum;
        };
        EXPECT_NEAR(curve.value(share), value(share), 1e-13);
        const double difference = (value(share + 1e-5) - value(share - 1e-5)) / 2e-5;
        EXPECT_NEAR(5 * curve.slope(share), difference, 1e-7);
    }
}

TEST(SignalCurve, IsTheCubicWithoutCurvatures) {
    const auto cubic = [](double t) { return Sample{t, t * t * t - 2 * t, 3 * t * t - 2, unknown}; };
    for (const bool one : {false, true}) {
        Sample end = cubic(1.5);
        if (one) end.curvature = 1000;  // one alone isn't used
        const SignalCurve curve(cubic(1), end);
        EXPECT_NEAR(curve.value(0.4), cubic(1.2).value, 1e-14);
        EXPECT_NEAR(curve.margin, 0, 1e-16);
    }
}

// The mismatch of the quartic's curvatures and its cubic's is 2 h^2 at both ends.
TEST(SignalCurve, HasTheMarginOfItsMismatchInCurvature) {
    const auto quartic = [](double t) { return Sample{t, std::pow(t, 4), 4 * std::pow(t, 3), 12 * t * t}; };
    EXPECT_NEAR(SignalCurve(quartic(0), quartic(0.5)).margin, std::pow(0.5, 4) / 800, 1e-16);
    Sample bent = quartic(0.5);
    bent.curvature += 3;
    EXPECT_NEAR(SignalCurve(quartic(0), bent).margin, 0.25 / 32 * 3.5 / 50, 1e-16);
    Sample other = quartic(0);
    other.curvature -= 3;
    EXPECT_NEAR(SignalCurve(other, quartic(0.5)).margin, 0.25 / 32 * 2.5 / 50, 1e-16);
}

// Of degree 6 a curve's coefficients are (k c[k-1] + (6 - k) c[k])/6.
TEST(SignalCurve, IsBoundedByItsCoefficientsOfDegreeSix) {
    for (std::size_t top = 0; top < 6; ++top) {
        Coefficients c{};
        c[top] = 1;
        const SignalCurve curve = curve_of(c);
        constexpr std::array largest{1.0, 5.0 / 6, 2.0 / 3, 2.0 / 3, 5.0 / 6, 1.0};
        const double middle = (c[2] + c[3]) / 2 + 3.2 * curve.margin;
        EXPECT_NEAR(curve.upper_bound(), std::max(largest[top], middle), 1e-13) << top;
    }
    const SignalCurve level = curve_of({-1, -1, -1, -1, -1, -1});
    EXPECT_NEAR(level.upper_bound(), -1, 1e-13);
}

// Level at both ends, with a curvature there that the cubic lacks: the bump of the margin, 64 m s^3 (1 - s)^3,
// is what decides in the middle, and of degree 6 its coefficient is 64 m/20.
TEST(SignalCurve, IsBoundedWithItsMargin) {
    const SignalCurve curve({0, 0, 0, 8}, {1, 0, 0, 8});
    EXPECT_NEAR(curve.margin, 8.0 / 32 / 50, 1e-16);
    EXPECT_NEAR(curve.upper_bound(), 8.0 / 20 + 64.0 / 20 * curve.margin, 1e-15);
}

TEST(SignalCurve, KnowsWhereItRisesAndBends) {
    EXPECT_TRUE(curve_of({0, 1, 2, 3, 4, 5}).rises());
    EXPECT_FALSE(curve_of({0, 1, 2, 1.5, 4, 5}).rises());
    EXPECT_FALSE(curve_of({0, 1, 2, 3, 4, 3.9}).rises());
    EXPECT_TRUE(curve_of({0, 2, 3.5, 4.5, 5, 5.2}).is_concave());
    EXPECT_FALSE(curve_of({0, 1, 2, 3, 4, 5}).is_concave());
    for (std::size_t bend = 0; bend < 4; ++bend) {
        Coefficients c{0, 2, 3.5, 4.5, 5, 5.2};
        c[bend + 1] -= 2;  // convex there alone, or beside
        EXPECT_FALSE(curve_of(c).is_concave()) << bend;
    }
}

TEST(SignChange, IsFoundFromEitherSide) {
    EXPECT_NEAR(sign_change([](double s) { return s - 0.3; }, true), 0.3, 1e-11);
    EXPECT_NEAR(sign_change([](double s) { return 0.7 - s; }, false), 0.7, 1e-11);
}

// A signal, and how often it was looked at.
template <class Signal>
struct Looked {
    Signal signal;
    int looks = 0;
    Sample operator()(double time) {
        ++looks;
        return signal(time);
    }
};

template <class SampleAt>
auto rise_between(const Sample& a, const Sample& b, SampleAt& sample_at, int depth = deepest_look) {
    int looks = most_looks;
    return first_rise(a, b, sample_at, looks, depth);
}

template <class SampleAt>
double largest_of(const Sample& a, const Sample& b, SampleAt& sample_at, double relative, double largest,
                  int depth = deepest_look) {
    int looks = most_looks;
    return largest_between(a, b, sample_at, relative, largest, looks, depth);
}

// A sin(w t + phase) + offset, with its derivatives.
auto wave(double amplitude, double rate, double phase, double offset) {
    return [=](double t) {
        const double angle = rate * t + phase;
        return Sample{t, amplitude * std::sin(angle) + offset, amplitude * rate * std::cos(angle),
                      -amplitude * rate * rate * std::sin(angle)};
    };
}

// Its top, at 1 in the middle of the step, is above 0 for a time much shorter than that.
TEST(FirstRise, SeesAHopThatNoEndShows) {
    for (const double above : {1e-3, 1e-6, 1e-9}) {
        Looked look{wave(1, 1, std::numbers::pi / 2 - 1, above - 1)};
        const auto rise = rise_between(look.signal(0.3), look.signal(1.6), look);
        ASSERT_TRUE(rise) << above;
        const double root = 1 - std::acos(1 - above);
        EXPECT_LE(rise->below.time, root);
        EXPECT_GE(rise->above.time, root);
        EXPECT_LE(rise->below.value, 0);
        EXPECT_GT(rise->above.value, 0);
        EXPECT_LT(look.looks, 60);
        Looked below{wave(1, 1, std::numbers::pi / 2 - 1, -above - 1)};
        EXPECT_FALSE(rise_between(below.signal(0.3), below.signal(1.6), below)) << above;
    }
}

TEST(FirstRise, IsTheFirstOfSeveral) {
    Looked look{wave(1, 8, std::numbers::pi, 0)};  // rises at pi/8, 3 pi/8, ...
    const auto rise = rise_between(look.signal(0.1), look.signal(1.3), look);
    ASSERT_TRUE(rise);
    EXPECT_LE(rise->below.time, std::numbers::pi / 8);
    EXPECT_GE(rise->above.time, std::numbers::pi / 8);
    EXPECT_LT(rise->above.time, 3 * std::numbers::pi / 8);
}

TEST(FirstRise, LooksNowhereWhereTheCurveRisesOrStaysBelow) {
    Looked look{wave(1, 1, 0, 0)};
    const auto rise = rise_between(look.signal(-0.5), look.signal(0.5), look);
    ASSERT_TRUE(rise);
    EXPECT_EQ(rise->below.time, -0.5);
    EXPECT_EQ(rise->above.time, 0.5);
    EXPECT_FALSE(rise_between(look.signal(-1.5), look.signal(-0.5), look));
    EXPECT_EQ(look.looks, 0);
}

// Without a look left, what both ends show counts.
TEST(FirstRise, EndsAtItsDepth) {
    Looked look{wave(1, 8, std::numbers::pi, 0)};
    const Sample below = look.signal(0.1);
    EXPECT_FALSE(rise_between(below, look.signal(0.9), look, 0));
    EXPECT_TRUE(rise_between(below, look.signal(0.5), look, 0));
    EXPECT_EQ(look.looks, 0);
}

// Noise, of which each half looks as if it might hold more: 2^24 samples wouldn't tell.
TEST(FirstRise, GivesUpInNoise) {
    std::mt19937 random(3);
    std::normal_distribution<double> normal;
    Looked look{[&](double t) {
        return Sample{t, -1e-3 - 1e-6 * std::abs(normal(random)), 1e6 * normal(random), 1e12 * normal(random)};
    }};
    int looks = 1000;
    EXPECT_FALSE(first_rise(look.signal(0), look.signal(1), look, looks));
    EXPECT_EQ(looks, 0);
    EXPECT_EQ(look.looks, 1000);
    looks = 1000;
    largest_between(look.signal(0), look.signal(1), look, 1e-9, 1, looks);
    EXPECT_LE(looks, 0);
    EXPECT_LE(look.looks, 2000 + deepest_look);
}

TEST(LargestBetween, IsThatInsideOrAtAnEnd) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> phase(0, 2 * std::numbers::pi);
    for (int n = 0; n < 100; ++n) {
        const double begin = phase(random);
        const double length = 0.1 + 0.2 * (n % 20);
        Looked look{wave(2, 1, 0, 5)};
        double top = std::max(look.signal(begin).value, look.signal(begin + length).value);
        for (const double peak : {std::numbers::pi / 2, 2.5 * std::numbers::pi, 4.5 * std::numbers::pi}) {
            if (begin < peak && peak < begin + length) top = 7;
        }
        const auto found = largest_of(look.signal(begin), look.signal(begin + length), look, 1e-9, 0);
        EXPECT_NEAR(found, top, 2e-8) << n;
        EXPECT_LT(look.looks, 200) << n;
    }
}

TEST(LargestBetween, OfTwoHumpsIsTheHigher) {
    Looked look{[](double t) { return Sample{t, std::sin(t) + 0.1 * t, std::cos(t) + 0.1, -std::sin(t)}; }};
    const double top = std::acos(-0.1) + 2 * std::numbers::pi;
    for (const double relative : {1e-6, 1e-10}) {
        const double found = largest_of(look.signal(0), look.signal(9), look, relative, -10);
        EXPECT_NEAR(found, look.signal(top).value, 2 * relative);
    }
}

TEST(LargestBetween, LooksNoFurtherWhereNothingExceedsTheLargestSoFar) {
    Looked look{wave(1, 1, 0, 0)};
    EXPECT_EQ(largest_of(look.signal(1), look.signal(2), look, 1e-9, 3), 3);
    EXPECT_EQ(look.looks, 0);
    EXPECT_EQ(largest_of(look.signal(0.2), look.signal(1), look, 1e-9, 0), look.signal(1).value);
    EXPECT_EQ(largest_of(look.signal(2), look.signal(3), look, 1e-9, 0), look.signal(2).value);
    EXPECT_EQ(look.looks, 0);
    EXPECT_NEAR(largest_of(look.signal(1), look.signal(2), look, 1e-9, 0), 1, 1e-12);
    EXPECT_EQ(look.looks, 1);  // the top of a concave curve, and the parabola's correction
    EXPECT_LT(largest_of(look.signal(1), look.signal(2), look, 0.1, 0.95), 0.96);
    EXPECT_EQ(look.looks, 1);
    EXPECT_LT(largest_of(look.signal(1), look.signal(2.5), look, 1e-9, 0, 0), 1);
    EXPECT_EQ(look.looks, 1);
}

// No parabola has its top where there is no curvature.
TEST(LargestBetween, IsTheSampleAtAFlatTop) {
    const auto parabola = [](double t) { return Sample{t, -(t - 1) * (t - 1), -2 * (t - 1), -2}; };
    for (const double slope : {0.0, 1e-3}) {
        const auto flat = [&](double time) { return Sample{time, 0.25, slope, 0}; };
        EXPECT_EQ(largest_of(parabola(0), parabola(1.7), flat, 1e-9, -10), 0.25) << slope;
    }
}

// The curvature at the top isn't known: its value is taken as it is.
TEST(LargestBetween, NeedsNoCurvature) {
    Looked look{[](double t) { return Sample{t, -(t - 1) * (t - 1), -2 * (t - 1), unknown}; }};
    EXPECT_NEAR(largest_of(look.signal(0), look.signal(1.7), look, 1e-9, -10), 0, 1e-15);
}

}  // namespace
}  // namespace peterka::integrators
