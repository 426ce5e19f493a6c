// A rigid stop in the integrators, against the closed form and the formulas of its orbits.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>
#include <utility>

#include "integrator_settings.hpp"
#include "integrators/integrated_cycle_map.hpp"
#include "regime/steady_state.hpp"
#include "rig.hpp"
#include "rigid_rig.hpp"
#include "trajectory/exact_cycle_map.hpp"
#include "trajectory/recorder.hpp"
#include "trajectory/split_cycle_map.hpp"

namespace peterka::trajectory {
namespace {

using integrators::IntegratedCycleMap;
using integrators::Integrator;

using testing::every_integrator;
using testing::every_tolerance;
using testing::label;
using testing::rigid;
using Outcome = Cycle<double>::Outcome;

// Single impacts, chatter that ends in sticking, and hops that do not; r from plastic to elastic.
TEST(IntegratedRigidStop, AgreesWithTheClosedFormFromRandomStarts) {
    std::mt19937 random(23);
    std::uniform_real_distribution<double> unit(0, 1);
    int impacts = 0;
    int rests = 0;
    for (int n = 0; n < 30; ++n) {
        const double restitution = std::array{0.0, 0.3, 0.6, 0.9, 1.0}[static_cast<std::size_t>(n % 5)];
        const double zeta = 0.1 * unit(random);  // separately: the evaluation order of arguments is unspecified
        const double gap = -1.2 + 1.8 * unit(random);
        const auto oscillator = rigid(restitution, 0.5 + 3 * unit(random), gap, zeta);
        const double velocity = 4 * unit(random) - 2;
        const State<double> start(-2 * unit(random), velocity);
        Recorder<double> expected(Detail::energy);
        const auto exact = RigidExactMap<double>(oscillator)(start, &expected);
        const bool open = expected.is_open();
        expected.finish();
        impacts += exact.impacts;
        rests += expected.totals().contact_time > 0 ? 1 : 0;
        for (const Integrator integrator : every_integrator) {
            for (const double tolerance : every_tolerance) {
                SCOPED_TRACE(label(integrator, tolerance) << ", scene " << n << ", r " << restitution);
                Recorder<double> recorder(Detail::energy);
                const auto cycle = IntegratedCycleMap(oscillator, integrator, tolerance)(start, &recorder);
                ASSERT_EQ(cycle.outcome, exact.outcome);
                EXPECT_EQ(recorder.is_open(), open);
                recorder.finish();
                const auto& totals = recorder.totals();
                const auto& truth = expected.totals();
                // completed chatters have infinitely many impacts, truncated at different ones
                EXPECT_EQ(totals.impacts, truth.impacts);
                EXPECT_EQ(totals.chatter, truth.chatter);
                EXPECT_EQ(cycle.pattern, exact.pattern);
                EXPECT_EQ(cycle.touched, exact.touched);
                EXPECT_EQ(cycle.separated, exact.separated);
                const double growth = 1 + exact.jacobian.norm();
                const double allowed = 3 * tolerance * (1 + exact.end.norm()) * growth;
                EXPECT_LT((cycle.end - exact.end).norm(), allowed);
                EXPECT_LT((cycle.jacobian - exact.jacobian).norm(), 10 * allowed * growth);
                const double speed = 1 + truth.impact_speed;
                EXPECT_NEAR(totals.impact_speed, truth.impact_speed, 3 * tolerance * speed);
                EXPECT_NEAR(totals.impulse, truth.impulse, 3 * tolerance * speed);
                EXPECT_NEAR(totals.contact_time, truth.contact_time, 10 * tolerance);
                EXPECT_NEAR(totals.contact_work, truth.contact_work, 10 * tolerance * speed * speed);
                EXPECT_NEAR(totals.drive_work, truth.drive_work,
                            10 * tolerance * speed * speed * (1 + oscillator.drive()));
                EXPECT_NEAR(totals.damper_work, truth.damper_work, 10 * tolerance * speed * speed);
                EXPECT_NEAR(totals.largest_displacement, truth.largest_displacement, 3 * tolerance * speed);
                EXPECT_NEAR(totals.largest_force, truth.largest_force,
                            10 * tolerance * (1 + truth.largest_force));
            }
        }
    }
    EXPECT_GT(impacts, 60);
    EXPECT_GT(rests, 3);
}

// z = 1/n: the impact speeds of the formula, with r = 0.6 and zeta = 0.02.
TEST(IntegratedRigidStop, OrbitsHaveTheSpeedsOfTheFormula) {
    struct Orbit {
        double frequency, gap, speed;
        int period;
    };
    for (const Orbit& orbit : {Orbit{2, 0, 11.841323894932, 1}, Orbit{2, 0.5, 10.966655235621, 1},
                               Orbit{4, 0, 18.951633786639, 2}}) {
        const auto oscillator = rigid(0.6, orbit.frequency, orbit.gap);
        // T to the impact at phase psi: u = P sin(theta), with P sin(theta) = g - alpha V, of the exact engine
        const auto exact = regime::find_steady_state(
            oscillator, testing::start_at(oscillator, -orbit.speed / 3), {}, {}, {.detail = Detail::contacts});
        ASSERT_EQ(exact.period, orbit.period);
        ASSERT_NEAR(exact.impact_speed, orbit.speed, 1e-10);
        const State<double> start(exact.orbit_displacement - oscillator.gap + 0.01, exact.orbit_velocity);
        for (const auto engine : {regime::Engine::cvode, regime::Engine::arkode}) {
            for (const double tolerance : every_tolerance) {
                SCOPED_TRACE(::testing::Message() << static_cast<int>(engine) << " at " << tolerance);
                const auto cell = regime::find_steady_state(oscillator, start, {}, {engine, tolerance, 10},
                                                            {.detail = Detail::contacts});
                EXPECT_EQ(cell.impacts, 1);
                EXPECT_EQ(cell.period, orbit.period);
                EXPECT_NEAR(cell.impact_speed / orbit.speed, 1, 2 * tolerance);
                EXPECT_NEAR(cell.impulse / (1.6 * orbit.speed), 1, 2 * tolerance);
                EXPECT_NEAR(cell.multiplier, exact.multiplier, 20 * tolerance);
                EXPECT_TRUE(std::isnan(cell.peak_force));
            }
        }
    }
}

// Sticking lasts until the acceleration, its cubic part included, falls through 0: then all memory of the start
// is lost. One flight from a known phase follows, on which the integrators and the split map must agree.
TEST(IntegratedRigidStop, SticksWithCubicSprings) {
    for (const auto form : {job::CubicForm::relative, job::CubicForm::absolute}) {
        for (const double restitution : {0.0, 0.5}) {
            auto oscillator = rigid(restitution, 0.8, -0.2);
            oscillator.cubic = 2e-3;
            oscillator.cubic_form = form;
            const State<double> start(-0.4, 0.3);
            const auto split = RigidSplitMap<double>(oscillator, 512)(start);
            Recorder<double> recorder(Detail::contacts);
            const auto best =
                IntegratedCycleMap(oscillator, Integrator::arkode_explicit, 1e-11)(start, &recorder);
            ASSERT_TRUE(recorder.totals().chatter || restitution == 0);
            EXPECT_GT(recorder.totals().contact_time, 0.1);
            EXPECT_LT((split.end - best.end).norm(), 1e-5);
            EXPECT_EQ(best.jacobian.norm(), 0);
            // too strong for splitting
            oscillator.cubic = 0.8;
            const auto strong = IntegratedCycleMap(oscillator, Integrator::arkode_explicit, 1e-11)(start);
            for (const Integrator integrator : every_integrator) {
                for (const double tolerance : every_tolerance) {
                    SCOPED_TRACE(label(integrator, tolerance) << ", r " << restitution);
                    const auto cycle = IntegratedCycleMap(oscillator, integrator, tolerance)(start);
                    ASSERT_EQ(cycle.outcome, Outcome::done);
                    EXPECT_EQ(cycle.pattern, strong.pattern);
                    EXPECT_LT((cycle.end - strong.end).norm(), 2 * tolerance);
                }
            }
        }
    }
}

TEST(IntegratedRigidStop, NeverRunsForEver) {
    // so nearly elastic that chatter takes a million impacts
    const auto nearly = rigid(1 - 1e-6, 0.5, -0.2);
    EXPECT_EQ(IntegratedCycleMap(nearly, Integrator::cvode_adams, 1e-4)({-1e-3, 0}).outcome,
              RigidExactMap<double>(nearly)({-1e-3, 0}).outcome);
    const auto stop = rigid(0.6, 2, 0.5);
    EXPECT_EQ(IntegratedCycleMap(stop, Integrator::cvode_adams, 1e-6)({0.1, 0}).outcome, Outcome::inside_stop);
    EXPECT_EQ(IntegratedCycleMap(stop, Integrator::cvode_adams, 1e-6)({std::nan(""), 0}).outcome,
              Outcome::not_finite);
}

}  // namespace
}  // namespace peterka::trajectory
