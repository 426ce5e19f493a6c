// The decision procedure with a rigid stop: analytic orbits, a spurious formula solution, chatter, sticking.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "regime/growth.hpp"
#include "regime/steady_state.hpp"
#include "rig.hpp"
#include "rigid_rig.hpp"
#include "trajectory/exact_cycle_map.hpp"

namespace peterka::regime {
namespace {

using testing::rigid;
using testing::start_at;
using trajectory::Detail;

CellResult solved(const scene::Oscillator<double>& oscillator, const scene::State<double>& start,
                  const job::SteadyState& budget = {}) {
    return find_steady_state(oscillator, start, budget, {}, {.detail = Detail::contacts});
}

std::pair<int, int> z(const CellResult& cell) {
    return {cell.impacts, cell.period};
}

TEST(RigidRegimes, SingleImpactOrbitsHaveTheSpeedOfTheFormula) {
    struct Case {
        double eta, gap;
        int period;
        double speed;
    };
    for (const auto& [eta, gap, period, speed] :
         {Case{2, 0, 1, 11.841323894932}, Case{2, 0.5, 1, 10.966655235621}, Case{4, 0, 2, 18.951633786639}}) {
        const auto cell = solved(rigid(0.6, eta, gap), {-1 - gap, 0});
        ASSERT_EQ(cell.regime, Regime::periodic) << eta << " " << gap;
        EXPECT_EQ(z(cell), std::pair(1, period));
        EXPECT_NEAR(cell.impact_speed, speed, 1e-10 * speed);
        EXPECT_NEAR(cell.impulse, 1.6 * speed, 1e-10 * speed);
        const double length = 2 * std::numbers::pi * period / eta;
        EXPECT_NEAR(cell.contact_power, 0.32 * speed * speed / length, 1e-9 * cell.contact_power);
        EXPECT_EQ(cell.contact_time, 0);
        EXPECT_TRUE(std::isnan(cell.peak_force));
        EXPECT_FALSE(cell.chatter);
        EXPECT_LE(cell.max_displacement, cell.largest_displacement * (1 + 1e-12));
    }
}

// Beyond the formula's period doubling 1/1 no longer exists.
TEST(RigidRegimes, PeriodDoublesAtTheFormulasFrequency) {
    for (const auto& [gap, frequency] : {std::pair{0.0, 2.6609482425529}, std::pair{0.5, 2.494678798104}}) {
        EXPECT_EQ(z(solved(rigid(0.6, frequency - 1e-3, gap), {-1 - gap, 0})), std::pair(1, 1));
        EXPECT_EQ(z(solved(rigid(0.6, frequency + 1e-3, gap), {-1 - gap, 0})), std::pair(2, 2));
    }
}

// At eta = 1, gap = 0 the formula has a 1/1 orbit that passes through the stop (V = 1.930).
TEST(RigidRegimes, AnOrbitThroughTheStopIsNone) {
    const auto oscillator = rigid(0.6, 1, 0);
    for (const double velocity : {-2.0, -0.5, 0.0, 1.0}) {
        const auto cell = solved(oscillator, {-1, velocity});
        // limit found by a plain Runge-Kutta method with bisection
        ASSERT_EQ(cell.regime, Regime::periodic);
        EXPECT_EQ(z(cell), std::pair(2, 1)) << velocity;
        EXPECT_FALSE(cell.chatter);
        EXPECT_NEAR(cell.impact_speed, 1.963131, 1e-6);
        EXPECT_NEAR(cell.orbit_displacement, -1.4372541060637, 1e-10);
        EXPECT_NEAR(cell.orbit_velocity, 0.4940162935952, 1e-10);

        // in long double it closes, with the same number of impacts
        const trajectory::RigidExactMap<long double> map({.damping_ratio = 0.02L,
                                                          .contact = scene::Restitution<long double>{0.6L},
                                                          .frequency = 1,
                                                          .gap = 0});
        scene::State<long double> x(cell.orbit_displacement, cell.orbit_velocity);
        trajectory::Recorder<long double> recorder;
        for (int n = 0; n < cell.period; ++n) x = map(x, &recorder).end;
        recorder.reset_totals();
        const scene::State<long double> start = x;
        for (int n = 0; n < cell.period; ++n) x = map(x, &recorder).end;
        EXPECT_LT((x - start).norm(), 1e-14L);
        EXPECT_EQ(recorder.totals().impacts, cell.impacts);
    }
}

// The spring-dashpot stop converges to the rigid one with stiffness: impact speeds differ by kappa^-1/2.
TEST(RigidRegimes, IsTheLimitOfAStiffStop) {
    const double zeta_i = 0.2;
    const double restitution = 0.57174002758478;
    const auto limit = solved(rigid(restitution, 2, 0.5), {-1.5, 0});
    ASSERT_EQ(z(limit), std::pair(1, 1));
    EXPECT_NEAR(limit.impact_speed, 10.33883402105, 1e-10 * 10.3);
    double last = 0;
    for (const double stiffness : {1e6, 1e8, 1e10}) {
        const scene::Oscillator<double> oscillator{
            .damping_ratio = 0.02,
            .contact = scene::KelvinVoigt<double>{stiffness, 2 * zeta_i * std::sqrt(stiffness)},
            .frequency = 2,
            .gap = 0.5};
        const auto cell = solved(oscillator, {-1.5, 0});
        ASSERT_EQ(z(cell), std::pair(1, 1));
        const double difference = std::abs(cell.impact_speed - limit.impact_speed);
        EXPECT_GT(difference, 0);
        if (last > 0) {
            EXPECT_NEAR(last / difference, 10, 0.2);
        }
        last = difference;
        EXPECT_NEAR(cell.impulse, (1 + restitution) * cell.impact_speed,
                    10 / std::sqrt(stiffness) * cell.impulse);
    }
}

TEST(RigidRegimes, PreloadKeepsTheHammerOnTheStop) {
    const auto cell = solved(rigid(0.6, 0.5, -3.0), {-1, 0});
    EXPECT_EQ(cell.regime, Regime::sustained_contact);
    EXPECT_EQ(z(cell), std::pair(0, 1));
    EXPECT_NEAR(cell.peak_force, 3.25, 1e-14);
    EXPECT_EQ(cell.multiplier, 0);
    EXPECT_TRUE(std::isnan(cell.lyapunov));
    EXPECT_EQ(cell.max_displacement, 3);
    EXPECT_EQ(cell.contact_power, 0);
    EXPECT_EQ(cell.orbit_displacement, -3);
}

TEST(RigidRegimes, OutOfReachThereIsNoImpact) {
    const auto oscillator = rigid(0.6, 2, 1.5);
    const auto cell = solved(oscillator, {-1.5, -2});
    EXPECT_EQ(cell.regime, Regime::no_impact);
    EXPECT_EQ(cell.peak_force, 0);
    EXPECT_NEAR(cell.max_displacement, testing::free_amplitude(oscillator), 1e-9);
}

// Sticking erases all memory: multiplier 0, proved at once, one impact.
TEST(RigidRegimes, ChatterThatEndsInRestIsSuperstable) {
    struct Case {
        scene::Oscillator<double> oscillator;
        int impacts;
        bool chatter;
    };
    // an impact and a chatter; a chatter that continues across phase 0; one impact without rebound
    for (const auto& [oscillator, impacts, chatter] :
         {Case{rigid(0.6, 0.4, 0.05), 2, true}, Case{rigid(0.8, 0.8, -0.55), 1, true},
          Case{rigid(0, 2, 0), 1, false}}) {
        const auto cell = solved(oscillator, {-1 - oscillator.gap, 0});
        ASSERT_EQ(cell.regime, Regime::periodic) << oscillator.frequency;
        EXPECT_EQ(z(cell), std::pair(impacts, 1)) << oscillator.frequency;
        EXPECT_EQ(cell.chatter, chatter) << oscillator.frequency;
        EXPECT_EQ(cell.multiplier, 0);
        EXPECT_TRUE(std::isnan(cell.lyapunov));
        EXPECT_FALSE(std::isinf(cell.sensitivity));
        EXPECT_GT(cell.contact_time, 0);
        EXPECT_LT(cell.cycles, 40);
        EXPECT_EQ(cell.impact_rate, static_cast<double>(cell.impacts) / cell.period);
        // the same without contact details
        const auto plain = find_steady_state(oscillator, {-1 - oscillator.gap, 0}, {});
        EXPECT_EQ(z(plain), z(cell));
        EXPECT_EQ(plain.chatter, cell.chatter);
    }
}

// Between two sticking phases a perturbation may grow a lot; still,
// the motion after each repeats that after the previous one.
TEST(RigidRegimes, AHammerThatComesToRestAgainIsNeverChaotic) {
    const auto oscillator =
        rigid(0.32, 2.925196850393701, 0, testing::paper_rig(testing::beam_170mm, 1, 0).damping_ratio);
    const auto cell = solved(oscillator, start_at(oscillator));
    EXPECT_EQ(cell.regime, Regime::unresolved);
    EXPECT_EQ(cell.status, Status::budget);
    EXPECT_TRUE(cell.chatter);
    const auto longer = solved(oscillator, start_at(oscillator), {.max_period = 200});
    EXPECT_EQ(longer.regime, Regime::periodic);
    EXPECT_EQ(z(longer), std::pair(72, 68));
    EXPECT_EQ(longer.multiplier, 0);
}

TEST(RigidRegimes, NothingSettlesWithoutLoss) {
    const auto cell = solved(rigid(1, 1.7, 1.2, 0), {-1.5, 0}, {.chaos_cycles = 200});
    EXPECT_EQ(cell.regime, Regime::unresolved);
    EXPECT_EQ(cell.status, Status::conservative);
    EXPECT_NE(solved(rigid(1, 2, 0.5, 0.1), {-1.5, 0}).status, Status::conservative);
}

TEST(RigidRegimes, AStartInsideTheStopFails) {
    const auto cell = solved(rigid(0.6, 2, 0.5), {0.1, 0});
    EXPECT_EQ(cell.regime, Regime::failed);
    EXPECT_EQ(cell.status, Status::solver_failed);
}

TEST(RigidRegimes, SplitCarriesACubicSpring) {
    auto oscillator = rigid(0.6, 2, 0.5);
    const auto linear = solved(oscillator, {-1.5, 0});
    for (const double cubic : {1e-6, 2e-6}) {
        oscillator.cubic = cubic;
        const auto cell = find_steady_state(oscillator, {-1.5, 0}, {}, {Engine::split, 1e-9, 15},
                                            {.detail = Detail::contacts});
        ASSERT_EQ(z(cell), std::pair(1, 1));
        const double shift = cell.impact_speed / linear.impact_speed - 1;
        EXPECT_GT(std::abs(shift), 1e-2 * cubic);
        EXPECT_LT(std::abs(shift), 1e3 * cubic);
    }
}

TEST(RigidRegimes, GrowthStartsAnewWhenEveryDirectionDied) {
    Growth growth;
    const Eigen::Matrix2d doubles = 2 * Eigen::Matrix2d::Identity();
    for (int n = 0; n < 400; ++n) growth.advance(doubles);
    EXPECT_TRUE(growth.surely_positive());
    const double largest = growth.sensitivity();
    growth.advance(Eigen::Matrix2d::Zero());
    EXPECT_FALSE(growth.surely_positive());
    EXPECT_EQ(growth.sensitivity(), largest);
    EXPECT_EQ(growth.resets(), 1);
    for (int n = 0; n < 100; ++n) growth.advance(doubles);
    EXPECT_FALSE(growth.surely_positive());  // settling again
    for (int n = 0; n < 100; ++n) growth.advance(doubles);
    EXPECT_TRUE(growth.surely_positive());
    EXPECT_NEAR(growth.exponent(), std::log(2.0), 1e-12);
}

}  // namespace
}  // namespace peterka::regime
