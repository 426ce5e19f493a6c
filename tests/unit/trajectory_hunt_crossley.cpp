// Hunt and Crossley's stop in the integrators, against formulas of the collision and an independent
// integration.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "extrapolation_oracle.hpp"
#include "integrators/integrated_cycle_map.hpp"
#include "regime/steady_state.hpp"
#include "rig.hpp"
#include "trajectory/equation_of_motion.hpp"
#include "trajectory/recorder.hpp"

namespace peterka::trajectory {
namespace {

using integrators::IntegratedCycleMap;
using integrators::Integrator;

using scene::HuntCrossley;
using testing::ExtrapolationOracle;
using Outcome = Cycle<double>::Outcome;

constexpr std::array every_integrator{Integrator::cvode_adams, Integrator::cvode_bdf,
                                      Integrator::arkode_explicit, Integrator::arkode_implicit};
constexpr std::array every_tolerance{1e-4, 1e-6, 1e-9};

::testing::Message label(Integrator integrator, double tolerance) {
    constexpr std::array names{"cvode_adams", "cvode_bdf", "arkode_explicit", "arkode_implicit"};
    return ::testing::Message() << names[static_cast<std::size_t>(integrator)] << " at " << tolerance;
}

TEST(HuntCrossleyForce, HasTheDerivativesOfItsFormula) {
    for (const double n : {1.0, 1.3, 1.5, 2.0, 2.5}) {
        SCOPED_TRACE(n);
        const Oscillator<double> oscillator{.contact = HuntCrossley<double>{50, n, 0.4}, .frequency = 2};
        const auto response = [&](double position, double velocity) {
            return contact_response(oscillator, State<double>(position, velocity));
        };
        constexpr double h = 1e-5;
        const auto f = response(0.3, -0.7);
        EXPECT_NEAR(f.force, 50 * std::pow(0.3, n) * (1 - 0.28), 1e-13);
        EXPECT_NEAR(f.by_position, (response(0.3 + h, -0.7).force - response(0.3 - h, -0.7).force) / (2 * h),
                    1e-6);
        EXPECT_NEAR(f.by_velocity, (response(0.3, -0.7 + h).force - response(0.3, -0.7 - h).force) / (2 * h),
                    1e-8);
        EXPECT_NEAR(f.by_position_twice,
                    (response(0.3 + h, -0.7).by_position - response(0.3 - h, -0.7).by_position) / (2 * h),
                    1e-6);
        EXPECT_NEAR(f.by_both,
                    (response(0.3, -0.7 + h).by_position - response(0.3, -0.7 - h).by_position) / (2 * h),
                    1e-7);
        const auto touch = response(0, 2);  // continuous: no saltation
        EXPECT_EQ(touch.force, 0);
        EXPECT_EQ(touch.by_velocity, 0);
        EXPECT_EQ(std::isinf(touch.by_position_twice), n > 1 && n < 2);
    }
}

// So stiff a stop that spring and cart do nothing during the collision: m delta'' = -K delta^n (1 + D delta').
// With G(v) = v/D - ln(1 + D v)/D^2, the integral of v/(1 + D v): K delta^(n+1)/(n+1) = G(v0) - G(v) on the
// way.
struct Collision {
    double exponent;
    double dissipation;

    static constexpr double stiffness = 1e16;
    [[nodiscard]] double left(double v) const {
        if (dissipation == 0) return v * v / 2;
        return (v - std::log1p(dissipation * v) / dissipation) / dissipation;
    }
    [[nodiscard]] double force(double speed, double v) const {
        const double m = exponent + 1;
        const double depth = std::pow(m / stiffness * (left(speed) - left(v)), 1 / m);
        return stiffness * std::pow(depth, exponent) * (1 + dissipation * v);
    }
    [[nodiscard]] double peak_force(double speed) const {
        double low = 0;
        double high = speed;
        for (int n = 0; n < 200; ++n) {
            const double third = (high - low) / 3;
            (force(speed, low + third) < force(speed, high - third) ? low : high) =
                force(speed, low + third) < force(speed, high - third) ? low + third : high - third;
        }
        return force(speed, low);
    }
    // ln((1 + D v0)/(1 - D v1)) = D (v0 + v1)
    [[nodiscard]] double speed_after(double speed) const {
        double low = 0;
        double high = dissipation == 0 ? 2 * speed : std::min(speed, 1 / dissipation);
        for (int n = 0; n < 200; ++n) {
            const double middle = (low + high) / 2;
            (left(-middle) < left(speed) ? low : high) = middle;
        }
        return low;
    }
};

TEST(HuntCrossleyImpact, IsThatOfAFreeMass) {
    for (const double n : {1.0, 1.001, 1.5, 2.0, 2.5}) {
        for (const double dissipation : {0.0, 0.01, 0.3, 3.0, 100.0}) {
            const Collision collision{n, dissipation};
            const Oscillator<double> oscillator{
                .contact = HuntCrossley<double>{Collision::stiffness, n, dissipation},
                .frequency = 3,
                .gap = 1};
            for (const Integrator integrator : every_integrator) {
                if (dissipation == 100 && integrator == Integrator::cvode_adams)
                    continue;  // stiff: left to BDF
                for (const double tolerance : every_tolerance) {
                    SCOPED_TRACE(label(integrator, tolerance) << ", n " << n << ", D " << dissipation);
                    Recorder<double> recorder(Detail::contacts);
                    const auto cycle =
                        IntegratedCycleMap(oscillator, integrator, tolerance)({-2, -2}, &recorder);
                    const auto& totals = recorder.totals();
                    ASSERT_EQ(cycle.outcome, Outcome::done);
                    ASSERT_EQ(totals.impacts, 1);
                    const double speed = totals.impact_speed;
                    const double after = collision.speed_after(speed);
                    // what spring and cart do meanwhile: their acceleration times the duration
                    const double others = 20 * totals.contact_time;
                    EXPECT_NEAR(totals.impulse, speed + after, 2 * tolerance * speed + others);
                    EXPECT_NEAR(totals.contact_work, (speed * speed - after * after) / 2,
                                2 * tolerance * speed * speed + 2 * others);
                    EXPECT_NEAR(totals.peak_force() / collision.peak_force(speed), 1,
                                2 * tolerance + 2 * others);
                }
            }
        }
    }
}

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
                    // later impacts inherit what the motion between them does to errors
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

// Without dissipation a contact gives back what it took.
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

// K to 1e12 and D to 1e3: beyond what the oracle follows in reasonable time, so the integrators check each
// other.
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
                    // Adams follows the creeping return of such stops in more steps than it may take
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

// Peak forces of periodic orbits keep the tolerance asked for; the orbit itself is checked by the oracle.
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
        // over a period the drive brings in what stop and damper take
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

// A preload that never lets go: proved as an orbit, for nothing about this contact is linear.
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
