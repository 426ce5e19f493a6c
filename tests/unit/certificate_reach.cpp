// How far a motion reaches, against the motion itself.
#include "certificate/reach.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace peterka::certificate {
namespace {

// The largest |u| and |delta'| within a time, by classical Runge-Kutta steps.
Reach reached(const Phase<double>& phase, Vector<double> state, double time) {
    constexpr int steps = 2000;
    const double h = time / steps;
    const auto slope = [&](const Vector<double>& x, double t) {
        return Vector<double>{x.velocity, phase.acceleration(x, std::sin(phase.frequency() * t))};
    };
    const auto moved = [](const Vector<double>& x, const Vector<double>& by, double share) {
        return Vector<double>{x.position + share * by.position, x.velocity + share * by.velocity};
    };
    Reach most;
    for (int step = 0; step <= steps; ++step) {
        most.displacement = std::max(most.displacement, std::abs(state.position + phase.gap()));
        most.velocity = std::max(most.velocity, std::abs(state.velocity));
        const double t = step * h;
        const auto a = slope(state, t);
        const auto b = slope(moved(state, a, h / 2), t + h / 2);
        const auto c = slope(moved(state, b, h / 2), t + h / 2);
        const auto d = slope(moved(state, c, h), t + h);
        state = moved(moved(moved(moved(state, a, h / 6), b, h / 3), c, h / 3), d, h / 6);
    }
    return most;
}

// In the second rig the cubic force is so strong that the first, linear estimate of the reach does not hold.
TEST(CertificateReach, HoldsTheMotion) {
    struct Case {
        double cubic;
        Vector<double> state;
        double within;
    };
    for (const Case& each : {Case{0.05, {-2, 1}, 0.2}, Case{8, {0.5, 0}, 0.1}, Case{-8, {0.5, 0}, 0.1}}) {
        const RigOf<double> rig{.damping_ratio = 0.02, .frequency = 0.5, .gap = 0.5, .cubic = each.cubic};
        const Phase<double> phase(rig, false);
        const Reach bound = reach_of(phase, each.state, each.within);
        const Reach motion = reached(phase, each.state, each.within);
        EXPECT_LT(motion.displacement, bound.displacement);
        EXPECT_LT(motion.velocity, bound.velocity);
        EXPECT_LT(bound.displacement, 2.5 * motion.displacement);
    }
}

TEST(CertificateReach, InNoTimeIsTheStateItself) {
    const RigOf<double> rig{.damping_ratio = 0.02, .frequency = 2, .gap = 0.5, .cubic = 0.1};
    const Reach reach = reach_of(Phase<double>(rig, false), {-0.5, 3}, 0);
    EXPECT_EQ(reach.displacement, 0);
    EXPECT_NEAR(reach.velocity, 3, 1e-10);
}

}  // namespace
}  // namespace peterka::certificate
