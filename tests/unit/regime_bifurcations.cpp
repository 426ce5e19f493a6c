// Analytic orbits and the limits of 1/1: known to many digits independently (continuation, closed formulas).
#include <gtest/gtest.h>

#include <cmath>

#include "critical_parameter.hpp"
#include "regime/stroboscopic_map.hpp"
#include "rig.hpp"
#include "trajectory/free_flight.hpp"

namespace peterka::regime {
namespace {

using testing::beam_170mm;
using testing::critical_parameter;
using testing::paper_rig;
using testing::solve;

// Frequency at which the 1/1 orbit has a multiplier of +1, at a fold, or -1, at a period doubling.
double critical_frequency(double gap, double multiplier, double guess) {
    const CellResult nearby = solve(paper_rig(beam_170mm, guess, gap));
    EXPECT_EQ(nearby.impacts, 1);
    EXPECT_EQ(nearby.period, 1);
    const auto map_of = [gap](double frequency) {
        return trajectory::ExactCycleMap<double>(paper_rig(beam_170mm, frequency, gap));
    };
    constexpr double stays_on_the_branch = 0.05;
    return critical_parameter(map_of, multiplier, {nearby.orbit_displacement - gap, nearby.orbit_velocity},
                              guess, stays_on_the_branch);
}

TEST(LimitsOfOneToOne, PeriodDoublingAtGapZero) {
    EXPECT_NEAR(critical_frequency(0, -1, 2.65), 2.659361979, 2e-9);
}
TEST(LimitsOfOneToOne, PeriodDoublingAtGapOne) {
    EXPECT_NEAR(critical_frequency(1, -1, 2.26), 2.264326891, 2e-9);
}
TEST(LimitsOfOneToOne, LowerPeriodDoublingAtGapOne) {
    EXPECT_NEAR(critical_frequency(1, -1, 0.7195), 0.718391067, 2e-9);
}
TEST(LimitsOfOneToOne, FoldAtGapOneAndAHalf) {
    EXPECT_NEAR(critical_frequency(1.5, 1, 1.86), 1.862464993, 2e-9);
}

// No multiplier warns of the second, grazing contact (border collision): only the label shows it.
TEST(LimitsOfOneToOne, BorderCollisionAtGapZero) {
    double two = 1.145;
    double one = 1.155;
    ASSERT_EQ(solve(paper_rig(beam_170mm, two, 0)).impacts, 2);
    ASSERT_EQ(solve(paper_rig(beam_170mm, one, 0)).impacts, 1);
    while (one - two > 1e-9) {
        const double middle = (one + two) / 2;
        const CellResult cell = solve(paper_rig(beam_170mm, middle, 0));
        ASSERT_EQ(cell.period, 1);
        (cell.impacts == 1 ? one : two) = middle;
    }
    EXPECT_NEAR(one, 1.15008754, 1e-8);
}

scene::Oscillator<double> compliant(double stiffness) {
    return {.damping_ratio = 0.02,
            .contact = scene::KelvinVoigt<double>{stiffness, 2 * 0.2 * std::sqrt(stiffness)},
            .frequency = 2,
            .gap = 0.5};
}

TEST(CompliantOrbit, HasTheKnownPeakForce) {
    const std::pair<double, double> known[] = {
        {1e2, 45.9406095437}, {1e3, 226.0799272367}, {1e4, 810.7462082005}, {1e6, 8452.3499123961}};
    for (const auto& [stiffness, force] : known) {
        const CellResult cell = solve(compliant(stiffness), -1, 2);
        EXPECT_EQ(cell.impacts, 1) << stiffness;
        EXPECT_EQ(cell.period, 1) << stiffness;
        EXPECT_NEAR(cell.peak_force / force, 1, 1e-11) << stiffness;
    }
}

// The stiffer the stop, the closer to the rigid orbit's impact speed, as stiffness^-1/2.
TEST(CompliantOrbit, TendsToTheRigidOne) {
    const double rigid_speed = 10.33883402105;
    const double zeta = 0.2;
    const double peak_per_speed =
        std::exp(-zeta * (3 * std::acos(zeta) - std::numbers::pi) / std::sqrt(1 - zeta * zeta));
    const auto excess = [&](double stiffness) {
        return solve(compliant(stiffness), -1, 2).peak_force / (peak_per_speed * std::sqrt(stiffness)) -
               rigid_speed;
    };
    for (double stiffness = 1e8; stiffness < 1e15; stiffness *= 100) {
        EXPECT_NEAR(excess(stiffness) / excess(stiffness * 100), 10, 0.1) << stiffness;
    }
    EXPECT_NEAR(excess(1e20), 0, 1e-8);
}

// A hammer on its steady free motion stays there as long as that motion fits in front of the stop.
TEST(EdgeOfNoImpact, IsTheFreeAmplitude) {
    for (const double eta : {0.6, 0.9, 1.5, 3.0}) {
        const auto from_steady_flight = [eta](double share_of_amplitude) {
            auto oscillator = paper_rig(beam_170mm, eta, 0);
            oscillator.gap = testing::free_amplitude(oscillator) * share_of_amplitude;
            return find_steady_state(oscillator, trajectory::FreeFlight<double>(oscillator).steady(), {});
        };
        EXPECT_EQ(from_steady_flight(1 + 1e-9).regime, Regime::no_impact) << eta;
        EXPECT_NE(from_steady_flight(1 - 1e-9).regime, Regime::no_impact) << eta;
    }
}

}  // namespace
}  // namespace peterka::regime
