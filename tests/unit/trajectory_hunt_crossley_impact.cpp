// Hunt and Crossley's force and a single impact in the integrators, against the formulas of the collision.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "integrator_settings.hpp"
#include "trajectory/equation_of_motion.hpp"
#include "trajectory/recorder.hpp"

namespace peterka::trajectory {
namespace {

using integrators::IntegratedCycleMap;
using integrators::Integrator;

using scene::HuntCrossley;
using testing::every_integrator;
using testing::every_tolerance;
using testing::label;
using Outcome = Cycle<double>::Outcome;

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

// So stiff a stop that spring and cart have no effect during the collision: m
// delta'' = -K delta^n (1 + D delta'). With G(v) = v/D - ln(1 + D v)/D^2, the
// integral of v/(1 + D v): K delta^(n+1)/(n+1) = G(v0) - G(v) during compression.
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
                    // effect of spring and cart: their acceleration times the duration
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

}  // namespace
}  // namespace peterka::trajectory
