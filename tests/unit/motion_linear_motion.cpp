// The closed form of a linear phase against an independent integration, and against textbook motions.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "motion/linear_motion.hpp"

namespace peterka::motion {
namespace {

struct Case {
    const char* name;
    LinearEquation<double> equation;
    double duration;
};

// Classical Runge-Kutta in extended precision; its error is far below the tests' tolerance.
State<long double> integrate(const LinearEquation<double>& e, State<long double> x, long double phase,
                             long double duration) {
    const auto slope = [&](long double t, const State<long double>& s) {
        const long double forcing = e.offset + e.drive * std::sin(phase + e.frequency * t);
        return State<long double>(s[1], forcing - 2.0L * e.damping * s[1] - e.stiffness * s[0]);
    };
    const int steps = 20'000;
    const long double h = duration / steps;
    for (int n = 0; n < steps; ++n) {
        const long double t = n * h;
        const State<long double> k1 = slope(t, x);
        const State<long double> k2 = slope(t + h / 2, x + h / 2 * k1);
        const State<long double> k3 = slope(t + h / 2, x + h / 2 * k2);
        const State<long double> k4 = slope(t + h, x + h * k3);
        x += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
    }
    return x;
}

class LinearPhases : public ::testing::TestWithParam<Case> {};

TEST_P(LinearPhases, AgreeWithIntegration) {
    const auto& [name, equation, duration] = GetParam();
    const LinearMotion<double> motion(equation);
    const State<double> start(0.3, -1.7);
    const double phase = 1.1;
    const Moment<double> end = Leg<double>(motion, start, phase).at(duration);
    const State<long double> expected = integrate(equation, start.cast<long double>(), phase, duration);
    const double scale = 1 + static_cast<double>(expected.lpNorm<Eigen::Infinity>());
    EXPECT_NEAR(end.state[0], static_cast<double>(expected[0]), 1e-12 * scale) << name;
    EXPECT_NEAR(end.state[1], static_cast<double>(expected[1]), 1e-12 * scale * std::sqrt(equation.stiffness))
        << name;
}

TEST_P(LinearPhases, FlowIsTheDerivativeByTheStart) {
    const auto& [name, equation, duration] = GetParam();
    const LinearMotion<double> motion(equation);
    const State<double> start(0.3, -1.7);
    const State<double> moved(1.3, -1.7);  // the motion is affine in its start, so any difference is exact
    const Moment<double> a = Leg<double>(motion, start, 0.4).at(duration);
    const Moment<double> b = Leg<double>(motion, moved, 0.4).at(duration);
    const double scale = 1 + a.state.lpNorm<Eigen::Infinity>();
    EXPECT_NEAR(b.state[0] - a.state[0], a.flow(0, 0), 1e-12 * scale) << name;
    EXPECT_NEAR(b.state[1] - a.state[1], a.flow(1, 0), 1e-12 * scale * std::sqrt(equation.stiffness)) << name;
}

INSTANTIATE_TEST_SUITE_P(Motion, LinearPhases,
                         ::testing::Values(Case{"light damping", {0.0036, 1, -0.5, 4, 2}, 3.1},
                                           Case{"undamped", {0, 1, 0.2, 0.25, 0.5}, 6.0},
                                           Case{"undamped resonance", {0, 1, 0, 1, 1}, 6.2},
                                           Case{"a hair off resonance", {1e-9, 1, 0.1, 1, 1 + 1e-7}, 6.2},
                                           Case{"damped resonance", {0.0036, 1, 0, 1, 1}, 6.2},
                                           Case{"heavily damped", {0.9, 1, -1, 2.25, 1.5}, 4.0},
                                           Case{"nearly critical, under", {1 - 1e-10, 1, -1, 2.25, 1.5}, 4.0},
                                           Case{"critical", {1, 1, -1, 2.25, 1.5}, 4.0},
                                           Case{"nearly critical, over", {1 + 1e-10, 1, -1, 2.25, 1.5}, 4.0},
                                           Case{"overdamped", {5, 1, -1, 2.25, 1.5}, 4.0},
                                           Case{"stiff contact", {70, 23000, 0.5, 4, 2}, 0.3},
                                           Case{"overdamped contact", {400, 23000, 0.5, 4, 2}, 0.3}),
                         [](const auto& instance) {
                             std::string name = instance.param.name;
                             std::erase_if(name, [](char c) { return c == ' ' || c == ','; });
                             return name;
                         });

TEST(LinearMotion, FreeDecayFollowsItsEnvelope) {
    const double zeta = 0.05;
    const LinearMotion<double> motion({zeta, 1, 0, 0, 1});
    const double damped = std::sqrt(1 - zeta * zeta);
    const Leg<double> leg(motion, {1, -zeta}, 0);  // x = exp(-zeta t) cos(damped t)
    for (const double t : {0.1, 1.0, 10.0, 100.0}) {
        EXPECT_NEAR(leg.at(t).state[0], std::exp(-zeta * t) * std::cos(damped * t), 1e-14);
    }
}

TEST(LinearMotion, UndampedResonanceGrowsWithTime) {
    const LinearMotion<double> motion({0, 1, 0, 1, 1});
    const Leg<double> leg(motion, {0, 0}, 0);  // x = (sin t - t cos t)/2
    for (const double t : {0.01, 1.0, 3.0, 6.28}) {
        EXPECT_NEAR(leg.at(t).state[0], (std::sin(t) - t * std::cos(t)) / 2, 1e-15);
    }
}

TEST(LinearMotion, SteadyResponseHasTheResonanceAmplitude) {
    for (const double eta : {0.2, 0.99, 1.0, 1.01, 4.0}) {
        const double zeta = 0.02;
        const LinearMotion<double> motion({zeta, 1, 0, eta * eta, eta});
        EXPECT_NEAR(std::abs(motion.response()), eta * eta / std::hypot(1 - eta * eta, 2 * zeta * eta), 1e-13);
    }
}

}  // namespace
}  // namespace peterka::motion
