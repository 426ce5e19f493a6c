// What the batched engine and its scalar twin must agree to.
#pragma once

#include <gtest/gtest.h>

#include "batch_cases.hpp"

namespace peterka::testing {

// Both engines make rounding errors of some 1e-15 of the largest displacement, at resonance of its forced part
// (up to 140), per cycle; a cycle amplifies those made before its last impact by no more than its Jacobian,
// which the comparison divides by.
inline constexpr double state_tolerance = 1e-12;
inline constexpr double force_tolerance = 1e-11;
// The slope of the flow jumps by kappa at release, whose time both engines know to some rounding errors of the
// force.
inline constexpr double jacobian_tolerance = 1e-10;

inline void expect_agreement(const Comparison& c) {
    EXPECT_EQ(c.different_events, c.grazes);
    EXPECT_LE(c.grazes, c.cycles / 1000);
    EXPECT_LT(c.state, state_tolerance);
    EXPECT_LT(c.peak_force, force_tolerance);
    EXPECT_LT(c.jacobian, jacobian_tolerance);
    EXPECT_LT(c.bound_too_low, 1e-11);
    EXPECT_LT(c.bound_too_high, 0.25);  // the twin bounds the way out of the stop and the flight after it apart
}

}  // namespace peterka::testing
