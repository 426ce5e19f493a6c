// The scales of a contact against a free hammer followed to its deepest point by steps of Runge and Kutta.
#include "trajectory/contact_rates.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace peterka::trajectory {
namespace {

using scene::HuntCrossley;
using scene::Oscillator;
using scene::State;

// Where delta'' = -K delta^n (1 + D delta') comes to rest.
double deepest(const HuntCrossley<double>& stop, double delta, double velocity) {
    const auto rate = [&](const State<double>& x) {
        const double force = stop.stiffness * std::pow(x[0], stop.exponent) * (1 + stop.dissipation * x[1]);
        return State<double>(x[1], -force);
    };
    constexpr double step = 1e-4;
    State<double> x(delta, velocity);
    State<double> before = x;
    while (x[1] > 0) {
        before = x;
        const State<double> a = rate(x);
        const State<double> b = rate(x + step / 2 * a);
        const State<double> c = rate(x + step / 2 * b);
        const State<double> d = rate(x + step * c);
        x += step / 6 * (a + 2 * b + 2 * c + d);
    }
    const double share = before[1] / (before[1] - x[1]);  // of the last step, along which it decelerates evenly
    return before[0] + share * step * before[1] / 2;
}

TEST(ContactRates, LinearizeWhereAFreeHammerComesToRest) {
    for (const double dissipation : {1e-5, 9e-4, 0.4}) {
        for (const double exponent : {1.5, 3.0}) {
            const HuntCrossley<double> stop{20, exponent, dissipation};
            const Oscillator<double> oscillator{.damping_ratio = 0.02, .contact = stop, .frequency = 2};
            for (const double delta : {0.0, 0.3}) {
                for (const double velocity : {0.5, 1.5}) {
                    const double depth = deepest(stop, delta, velocity);
                    const double slope = stop.stiffness * std::pow(depth, exponent - 1);
                    const auto contact = linearized_contact(oscillator, {delta, velocity});
                    EXPECT_NEAR(contact.stiffness / (1 + exponent * slope), 1, 1e-5);
                    EXPECT_NEAR(contact.damping / (0.02 + dissipation * slope * depth / 2), 1, 1e-5);
                }
            }
        }
    }
}

// The spring at rest under a force: K d^n, or all of the force on the hammer's own springs where that is less.
TEST(ContactRates, KnowTheDepthUnderAForce) {
    const Oscillator<double> nonlinear{.contact = HuntCrossley<double>{50, 1.5, 0.3}, .frequency = 2};
    const double depth = static_depth(nonlinear, 4);
    EXPECT_NEAR(50 * std::pow(depth, 1.5), 4, 1e-12);
    const Oscillator<double> linear{.contact = scene::KelvinVoigt<double>{50, 3}, .frequency = 2};
    EXPECT_NEAR(51 * static_depth(linear, 4), 4, 1e-12);
}

}  // namespace
}  // namespace peterka::trajectory
