#include "noise/disturbance.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace peterka::noise {
namespace {

// A one-sided density S^2 in (m/s^2)^2/Hz is S^2/2 on both sides, so that the velocity of a free mass spreads
// with the variance S^2 t/2 (Papoulis & Pillai 2002, Probability, Random Variables, and Stochastic
// Processes, 10.1).
TEST(Disturbance, WhiteNoiseSpreadsTheVelocityOfAFreeMass) {
    const scene::Scales scales{.length_m = 2e-3, .frequency_rad_per_s = 50};
    const Disturbance disturbance = disturbance_of({.acceleration_m_s2_per_sqrt_hz = 0.3}, scales);
    const double seconds = 1.7;
    const double speed = disturbance.speed * std::sqrt(seconds * 50) * 2e-3 * 50;  // [m/s]
    EXPECT_NEAR(speed, 0.3 * std::sqrt(seconds / 2), 1e-14);
    EXPECT_EQ(disturbance.amplitude, 0);
}

TEST(Disturbance, DeviationsOfTheCartAreThoseOfTheJob) {
    const Disturbance disturbance =
        disturbance_of({.amplitude_relative = 0.02, .frequency_relative = 0.01}, {});
    EXPECT_EQ(disturbance.amplitude, 0.02);
    EXPECT_EQ(disturbance.frequency, 0.01);
    EXPECT_EQ(disturbance.speed, 0);
}

}  // namespace
}  // namespace peterka::noise
