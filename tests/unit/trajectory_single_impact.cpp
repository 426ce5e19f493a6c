// One impact of a free mass on the spring-dashpot stop, against the closed collision formulas.
#include <gtest/gtest.h>

#include <cmath>

#include "observed.hpp"
#include "trajectory/exact_cycle_map.hpp"

namespace peterka::trajectory {
namespace {

using testing::observed;

struct SpringDashpotCollision {
    double damping_ratio;  // of the contact
    double restitution;
};

class SingleImpact : public ::testing::TestWithParam<SpringDashpotCollision> {
  protected:
    // So stiff a stop that the beam spring and the cart have no effect during the collision.
    static constexpr double stiffness = 1e26;
    [[nodiscard]] scene::Oscillator<double> oscillator() const {
        return {.damping_ratio = 0.05,  // later impacts are weaker
                .contact =
                    scene::KelvinVoigt<double>{stiffness, 2 * GetParam().damping_ratio * std::sqrt(stiffness)},
                .frequency = 0.1,
                .gap = 0};
    }
};

TEST_P(SingleImpact, LosesSpeedByTheRestitution) {
    const auto oscillator = this->oscillator();
    const motion::LinearMotion<double> contact(motion::contact_equation(oscillator));
    const Leg<double> leg(contact, {0, 1}, 0);
    const Probe<double> release({.position = -stiffness, .velocity = -oscillator.kelvin_voigt().damping},
                                contact);
    const auto end = first_crossing(leg, release, leg.start(), 1.0);
    ASSERT_EQ(end.ending, Crossing<double>::Ending::crossing);
    EXPECT_NEAR(-end.moment.state[1], GetParam().restitution, 1e-12);
    EXPECT_LE(end.evaluations, 40);
    if (GetParam().damping_ratio < 1) {
        const double zeta = GetParam().damping_ratio;
        const double duration = 2 * std::acos(zeta) / std::sqrt(stiffness * (1 - zeta * zeta));
        EXPECT_NEAR(end.moment.time / duration, 1, 1e-12);
    }
}

TEST_P(SingleImpact, PeaksAsTheFormulaSays) {
    const double zeta = GetParam().damping_ratio;
    const auto cycle = observed(ExactCycleMap<double>(oscillator()), State<double>(0, 1));
    ASSERT_EQ(cycle.outcome, Cycle<double>::Outcome::done);
    const double expected =
        zeta > 0.5 ? 2 * zeta
                   : std::exp(-zeta * (3 * std::acos(zeta) - std::numbers::pi) / std::sqrt(1 - zeta * zeta));
    EXPECT_NEAR(cycle.peak_force / std::sqrt(stiffness), expected, 1e-12);
}

INSTANTIATE_TEST_SUITE_P(DampingRatios, SingleImpact,
                         ::testing::Values(SpringDashpotCollision{0, 1},
                                           SpringDashpotCollision{0.1, 0.74407939772178},
                                           SpringDashpotCollision{0.2, 0.57174002758478},
                                           SpringDashpotCollision{0.5, 0.29843605919227},
                                           SpringDashpotCollision{1, std::exp(-2.0)},
                                           SpringDashpotCollision{2, 0.04776873250562}));

}  // namespace
}  // namespace peterka::trajectory
