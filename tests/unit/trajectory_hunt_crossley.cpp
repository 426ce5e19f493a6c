// Cycles and orbits with Hunt and Crossley's stop in the integrators, against an independent integration.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "extrapolation_oracle.hpp"
#include "integrator_settings.hpp"
#include "regime/steady_state.hpp"
#include "rig.hpp"
#include "trajectory/recorder.hpp"

namespace peterka::trajectory {
namespace {

using integrators::IntegratedCycleMap;
using integrators::Integrator;

using scene::HuntCrossley;
using testing::every_integrator;
using testing::every_tolerance;
using testing::ExtrapolationOracle;
using testing::label;
using Outcome = Cycle<double>::Outcome;

Oscillator<double> random_scene(std::mt19937& random, double exponent) {
    std::uniform_real_distribution<double> unit(0, 1);
    Oscillator<double> oscillator{
        .damping_ratio = 0.2 * unit(random),
        .contact = HuntCrossley<double>{std::pow(10, 1 + 4 * unit(random)), exponent, 2 * unit(random)},
        .frequency = 0.6 + 3 * unit(random),
        .gap = -0.5 + 2 * unit(random)};
    if (unit(random) < 0.3) std::get<HuntCrossley<double>>(oscillator.contact).dissipation = 0;
    if (unit(random) < 0.4) oscillator.cubic = unit(random);
    if (unit(random) < 0.5) oscillator.cubic_form = job::CubicForm::absolute;
    return oscillator;
}

TEST(HuntCrossleyCycle, AgreesWithAnIndependentIntegration) {
    std::mt19937 random(17);
    std::uniform_real_distribution<double> state(-2, 2);
    int impacts = 0;
    for (const double n : {1.0, 1.05, 1.5, 1.5, 2.0, 2.5}) {
        for (int sample = 0; sample < 4; ++sample) {
            const auto oscillator = random_scene(random, n);
            const State<double> start(-1.2 - oscillator.gap, state(random));
            ExtrapolationOracle oracle(oscillator, start);
            oracle.advance(1);
            impacts += oracle.impacts();
            for (const Integrator integrator : every_integrator) {
                for (const double tolerance : every_tolerance) {
                    SCOPED_TRACE(label(integrator, tolerance) << ", n " << n << ", sample " << sample);
                    Recorder<double> recorder(Detail::energy);
                    const auto cycle = IntegratedCycleMap(oscillator, integrator, tolerance)(start, &recorder);
                    recorder.finish();
                    const auto& totals = recorder.totals();
                    ASSERT_EQ(cycle.outcome, Outcome::done);
                    EXPECT_EQ(cycle.impacts, oracle.impacts());
                    const double allowed = tolerance * (1 + cycle.end.norm()) * (1 + cycle.jacobian.norm());
                    EXPECT_LT((cycle.end - oracle.state()).norm(), allowed);
                    // later impacts inherit the error growth of the motion between them
                    const double speed = oracle.impact_speed();
                    const double energy = 1 + speed * speed;
                    EXPECT_NEAR(totals.peak_force(), oracle.peak_force(), 3 * tolerance * oracle.peak_force());
                    EXPECT_NEAR(totals.impact_speed, speed, 3 * tolerance * (1 + speed));
                    EXPECT_NEAR(totals.impulse, oracle.largest_impulse(), 3 * tolerance * (1 + speed));
                    EXPECT_NEAR(totals.contact_time, oracle.contact_time(), 3 * tolerance * (1 + speed));
                    EXPECT_NEAR(totals.contact_work, oracle.contact_work(), 3 * tolerance * energy);
                    EXPECT_NEAR(totals.drive_work, oracle.drive_work(),
                                3 * tolerance * energy * oscillator.drive());
                    EXPECT_NEAR(totals.damper_work, oracle.damper_loss(), 3 * tolerance * energy);
                    EXPECT_NEAR(totals.largest_displacement, oracle.largest_displacement(),
                                tolerance * (1 + oracle.largest_displacement()));
                    EXPECT_GE(totals.displacement_bound * (1 + tolerance), oracle.largest_displacement());
                }
            }
        }
    }
    EXPECT_GT(impacts, 24);
}

TEST(HuntCrossleyCycle, JacobianIsTheDerivative) {
    for (const double n : {1.0, 1.2, 1.5, 2.5}) {
        const Oscillator<double> oscillator{
            .damping_ratio = 0.02, .contact = HuntCrossley<double>{300, n, 0.4}, .frequency = 1.7, .gap = 0.4};
        const State<double> x(-1.5, 0.8);
        constexpr double h = 1e-4;
        Jacobian<double> slope;
        for (int i = 0; i < 2; ++i) {
            const auto end = [&](double shift) {
                ExtrapolationOracle oracle(oscillator, x + shift * State<double>::Unit(i));
                oracle.advance(1);
                return oracle.state();
            };
            slope.col(i) = (8 * (end(h) - end(-h)) - (end(2 * h) - end(-2 * h))) / (12 * h);
        }
        for (const Integrator integrator : every_integrator) {
            for (const double tolerance : every_tolerance) {
                SCOPED_TRACE(label(integrator, tolerance) << ", n " << n);
                const auto cycle = IntegratedCycleMap(oscillator, integrator, tolerance)(x, nullptr);
                EXPECT_GT(cycle.impacts, 0);
                const double size = 1 + slope.norm();
                EXPECT_LT((cycle.jacobian - slope).norm(), (20 * tolerance + 1e-8) * size * size);
            }
        }
    }
}

// Without dissipation a contact returns all energy.
TEST(HuntCrossleyCycle, ElasticContactsTakeNoWork) {
    for (const double n : {1.0, 1.5, 2.5}) {
        const Oscillator<double> oscillator{
            .damping_ratio = 0.1, .contact = HuntCrossley<double>{1e4, n, 0}, .frequency = 1.3, .gap = 0.2};
        for (const Integrator integrator : every_integrator) {
            for (const double tolerance : every_tolerance) {
                SCOPED_TRACE(label(integrator, tolerance) << ", n " << n);
                Recorder<double> recorder(Detail::contacts);
                const auto cycle = IntegratedCycleMap(oscillator, integrator, tolerance)({-1.4, 2}, &recorder);
                ASSERT_GT(cycle.impacts, 0);
                ASSERT_FALSE(recorder.is_open());
                const double speed = recorder.totals().impact_speed;
                EXPECT_GT(speed, 0.1);
                EXPECT_NEAR(recorder.totals().contact_work, 0, tolerance * speed * speed * cycle.impacts);
            }
        }
    }
}

// K to 1e12 and D to 1e3: beyond what the oracle can follow
// in reasonable time, so the integrators check each other.
TEST(HuntCrossleyCycle, IntegratorsAgreeOnExtremeStops) {
    constexpr double tolerance = 1e-6;
    for (const double stiffness : {1e-2, 1e6, 1e12}) {
        for (const double dissipation : {0.0, 1.0, 1e3}) {
            for (const double n : {1.0, 1.5, 2.5}) {
                if (n == 1 && dissipation == 1e3 && stiffness == 1e12) continue;  // rings for a million radians
                const Oscillator<double> oscillator{.damping_ratio = 0.02,
                                                    .contact = HuntCrossley<double>{stiffness, n, dissipation},
                                                    .frequency = 1.5,
                                                    .gap = 0.3};
                SCOPED_TRACE(::testing::Message() << "K " << stiffness << ", D " << dissipation << ", n " << n);
                std::vector<Cycle<double>> cycles;
                std::vector<double> forces;
                for (const Integrator integrator : every_integrator) {
                    // Adams needs too many steps for the creeping return of such stops
                    if (dissipation == 1e3 && integrator == Integrator::cvode_adams) continue;
                    Recorder<double> recorder;
                    cycles.push_back(
                        IntegratedCycleMap(oscillator, integrator, tolerance)({-1.5, 1}, &recorder));
                    forces.push_back(recorder.totals().peak_force());
                    ASSERT_EQ(cycles.back().outcome, Outcome::done);
                    ASSERT_GT(cycles.back().impacts, 0);
                    for (std::size_t other = 0; other + 1 < cycles.size(); ++other) {
                        SCOPED_TRACE(label(integrator, tolerance) << " and " << other);
                        const double sensitivity = 1 + cycles.back().jacobian.norm();
                        EXPECT_LT((cycles[other].end - cycles.back().end).norm(),
                                  2 * tolerance * (1 + cycles.back().end.norm()) * sensitivity);
                        EXPECT_NEAR(forces[other] / forces.back(), 1, 2 * tolerance);
                    }
                }
            }
        }
    }
}

struct Place {
    double frequency;
    double gap;
    double stiffness;
    double exponent;
    double dissipation;
};

// Peak forces of periodic orbits meet the requested tolerance; the oracle checks the orbit itself.
TEST(HuntCrossleyOrbits, KeepTheToleranceAskedFor) {
    using regime::Engine;
    for (const Place& place :
         {Place{2.0, 0.0, 2e4, 1.5, 0.2}, Place{1.5, 0.5, 1e6, 1.0, 0.5}, Place{2.8, 0.0, 300, 2.5, 1.0},
          Place{0.8, 0.6, 1e5, 2.0, 0.1}, Place{4.2, 0.5, 1e4, 1.5, 0.4}}) {
        const Oscillator<double> oscillator{
            .damping_ratio = 0.02,
            .contact = HuntCrossley<double>{place.stiffness, place.exponent, place.dissipation},
            .frequency = place.frequency,
            .gap = place.gap};
        const auto solved = [&](Engine engine, double tolerance) {
            return regime::find_steady_state(oscillator, testing::start_at(oscillator), {},
                                             {engine, tolerance, 10}, {.detail = Detail::contacts});
        };
        const auto best = solved(Engine::arkode, 1e-11);
        SCOPED_TRACE(::testing::Message()
                     << "frequency " << place.frequency << ", z " << best.impacts << "/" << best.period);
        ASSERT_EQ(best.regime, regime::Regime::periodic);
        ASSERT_GT(best.impacts, 0);
        const State<double> point(best.orbit_displacement - oscillator.gap, best.orbit_velocity);
        ExtrapolationOracle oracle(oscillator, point);
        oracle.advance(best.period);
        EXPECT_LT((oracle.state() - point).norm(), 1e-10 * (1 + point.norm()));
        EXPECT_EQ(oracle.impacts(), best.impacts);
        EXPECT_NEAR(best.peak_force / oracle.peak_force(), 1, 1e-10);
        // over a period the drive supplies what stop and damper dissipate
        EXPECT_NEAR(oracle.drive_work(), oracle.damper_loss() + oracle.contact_work(),
                    1e-9 * oracle.drive_work());
        EXPECT_NEAR(best.contact_power * oscillator.period() * best.period, oracle.contact_work(),
                    1e-9 * oracle.drive_work());
        for (const Engine engine : {Engine::cvode, Engine::arkode}) {
            for (const double tolerance : every_tolerance) {
                SCOPED_TRACE(::testing::Message() << static_cast<int>(engine) << " at " << tolerance);
                const auto cell = solved(engine, tolerance);
                EXPECT_EQ(cell.impacts, best.impacts);
                EXPECT_EQ(cell.period, best.period);
                EXPECT_NEAR(cell.peak_force / oracle.peak_force(), 1, tolerance);
                EXPECT_NEAR(cell.contact_power / best.contact_power, 1, 4 * tolerance);
            }
        }
    }
}

// A preload that never separates: proved as an orbit, because this contact is nonlinear.
TEST(HuntCrossleyOrbits, SustainedContactIsFound) {
    const Oscillator<double> oscillator{
        .damping_ratio = 0.1, .contact = HuntCrossley<double>{50, 1.5, 0.5}, .frequency = 0.5, .gap = -2};
    const auto cell = regime::find_steady_state(oscillator, {-0.5, 0}, {}, {regime::Engine::cvode, 1e-8, 10});
    EXPECT_EQ(cell.regime, regime::Regime::sustained_contact);
    ExtrapolationOracle oracle(oscillator, {cell.orbit_displacement - oscillator.gap, cell.orbit_velocity});
    oracle.advance(1);
    EXPECT_EQ(oracle.impacts(), 0);
    EXPECT_NEAR(cell.peak_force / oracle.peak_force(), 1, 1e-8);
}

}  // namespace
}  // namespace peterka::trajectory
