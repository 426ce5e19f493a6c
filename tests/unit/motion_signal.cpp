// Bounds of signals, against motions in closed form.
#include "motion/signal.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace peterka::motion {
namespace {

// From rest, x'' + w^2 x = A sin(w t) has x'' = A/2 (sin(w t) + w t cos(w t)), up to pi A within a cycle.
TEST(Probe, BoundsTheResponseFromRestAtUndampedResonance) {
    constexpr double drive = 2;
    for (const double rate : {0.5, 1.0, 3.0}) {
        const LinearMotion<double> motion(
            {.damping = 0, .stiffness = rate * rate, .drive = drive, .frequency = rate});
        ASSERT_TRUE(motion.resonant());
        const Leg<double> leg(motion, {0, 0}, 0);
        const Probe<double> position({.position = 1}, motion);
        const double bound = position.bounds(leg.start()).curvature;
        EXPECT_GE(bound, std::numbers::pi * drive) << rate;
        EXPECT_LE(bound, 3 * std::numbers::pi * drive) << rate;
    }
}

}  // namespace
}  // namespace peterka::motion
