// Components of the integrators: the equation of motion, and the search of a step for events.
#include "trajectory/equation_of_motion.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "integrators/search.hpp"

namespace peterka::trajectory {
namespace {

using integrators::first_rise;
using integrators::Sample;

// Signals spanning one radian between two samples, in closed form.
TEST(StepSearch, FindsHopsAndMaximaBetweenSamples) {
    const auto hop = [](double offset, double phase) {
        return [=](double t) {
            return Sample{t, std::cos(t - phase) - offset, -std::sin(t - phase), -std::cos(t - phase)};
        };
    };
    const auto high = hop(0.9999, 0.3);
    int looks = integrators::most_looks;
    const auto found = first_rise(high(0), high(1), high, looks);
    ASSERT_TRUE(found);
    const double rise = 0.3 - std::acos(0.9999);
    EXPECT_LE(found->below.time, rise);
    EXPECT_GE(found->above.time, rise);
    EXPECT_LT(found->above.time, 0.3 + std::acos(0.9999));
    const auto low = hop(1 + 1e-9, 0.3);
    EXPECT_FALSE(first_rise(low(0), low(1), low, looks));
    // leaving the surface downwards is not a rise, returning is
    auto leaving = [](double t) { return Sample{t, t * (t - 0.6), 2 * t - 0.6, 2}; };
    EXPECT_FALSE(first_rise(leaving(0), leaving(0.5), leaving, looks));
    const auto back = first_rise(leaving(0), leaving(1), leaving, looks);
    ASSERT_TRUE(back);
    EXPECT_LE(back->below.time, 0.6);
    EXPECT_GE(back->above.time, 0.6);
    EXPECT_NEAR(largest_between(high(0), high(1), high, 1e-12, 0, looks), 1e-4, 1e-12);
    EXPECT_EQ(largest_between(high(0), high(1), high, 1e-12, 0.5, looks), 0.5);
}

TEST(EquationOfMotion, CubicFormsDifferAsComputedByHand) {
    Oscillator<double> oscillator{.damping_ratio = 0.1, .frequency = 2, .gap = 0.25, .cubic = 0.5};
    const double theta = std::numbers::pi / 6;  // y = 1/2
    const State<double> x(0.75, 2);             // u = 1, x = 3/2
    const double cosine = std::sqrt(3.0) / 2;
    const auto relative = acceleration(oscillator, Phase::flight, x, theta);
    EXPECT_NEAR(relative.value, 4 * 0.5 - 0.4 - 1 - 0.5, 1e-14);
    EXPECT_NEAR(relative.by_position, -1 - 1.5, 1e-14);
    EXPECT_NEAR(relative.by_velocity, -0.2, 1e-14);
    EXPECT_NEAR(relative.by_time, 8 * cosine, 1e-14);
    EXPECT_NEAR(relative.by_position_twice, -3, 1e-14);
    oscillator.cubic_form = job::CubicForm::absolute;
    const auto absolute = acceleration(oscillator, Phase::flight, x, theta);
    EXPECT_NEAR(absolute.value, 4 * 0.5 - 0.4 - 1 - 0.5 * (27.0 / 8 - 1.0 / 8), 1e-14);
    EXPECT_NEAR(absolute.by_position, -1 - 1.5 * 9.0 / 4, 1e-14);
    EXPECT_NEAR(absolute.by_time, 8 * cosine - 1.5 * (9.0 / 4 - 1.0 / 4) * 2 * cosine, 1e-14);
    EXPECT_NEAR(absolute.by_position_twice, -4.5, 1e-14);
    oscillator.kelvin_voigt().stiffness = 100;
    oscillator.kelvin_voigt().damping = 7;
    const auto contact = acceleration(oscillator, Phase::contact, x, theta);
    EXPECT_NEAR(contact.value, absolute.value - 75 - 14, 1e-12);
    EXPECT_NEAR(contact.by_position, absolute.by_position - 100, 1e-12);
    EXPECT_NEAR(contact.by_velocity, -7.2, 1e-14);
    EXPECT_EQ(acceleration(oscillator, Phase::unloaded, x, theta).value, absolute.value);
}

}  // namespace
}  // namespace peterka::trajectory
