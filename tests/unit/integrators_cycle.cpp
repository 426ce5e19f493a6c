// Why a cycle can't be integrated.
#include "integrators/cycle.hpp"

#include <gtest/gtest.h>

#include "integrators/integrated_cycle_map.hpp"

namespace peterka::integrators {
namespace {

// Softening springs with an unstable equilibrium at u = 1, at which they push nowhere; the hammer passes so
// fast that the next step overflows.
TEST(CycleIntegration, OnlyBeyondItsEquilibriumIsAHammerThrownOutByItsSprings) {
    const Oscillator<double> oscillator{.frequency = 2, .gap = 2, .cubic = -1};
    for (const auto integrator : {Integrator::cvode_adams, Integrator::cvode_bdf, Integrator::arkode_explicit,
                                  Integrator::arkode_implicit}) {
        const auto outcome_from = [&](double u) {
            return IntegratedCycleMap(oscillator, integrator, 1e-6)({u - oscillator.gap, 1e200}).outcome;
        };
        EXPECT_EQ(outcome_from(0.875), Cycle<double>::Outcome::solver_failed);
        EXPECT_EQ(outcome_from(1), Cycle<double>::Outcome::solver_failed);
        EXPECT_EQ(outcome_from(1.125), Cycle<double>::Outcome::not_finite);
    }
}

}  // namespace
}  // namespace peterka::integrators
