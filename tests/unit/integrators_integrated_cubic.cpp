// CVODE and ARKODE with cubic springs, against direct summation, differences and balances.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "integrator_settings.hpp"
#include "observed.hpp"
#include "rig.hpp"
#include "trajectory/cycle.hpp"

namespace peterka::trajectory {
namespace {

using testing::beam_170mm;
using testing::EveryIntegrator;
using testing::observed;
using testing::paper_rig;
using Outcome = Cycle<double>::Outcome;

Oscillator<double> cubic_rig(double cubic, job::CubicForm form) {
    auto oscillator = paper_rig(beam_170mm, 1.7, 0.4);
    oscillator.cubic = cubic;
    oscillator.cubic_form = form;
    return oscillator;
}

TEST_P(EveryIntegrator, JacobianIsTheDerivativeWithCubicSprings) {
    const double h = std::cbrt(tolerance()) / 10;
    for (const auto form : {job::CubicForm::relative, job::CubicForm::absolute}) {
        for (const double cubic : {1e-3, 0.3, 20.0}) {
            SCOPED_TRACE(cubic);
            auto engine = map(cubic_rig(cubic, form));
            const State<double> x(-1.5, 0.8);
            const auto cycle = engine(x);
            EXPECT_GT(cycle.impacts, 0);
            for (int i = 0; i < 2; ++i) {
                const State<double> shift = h * State<double>::Unit(i);
                const State<double> slope = (engine(x + shift).end - engine(x - shift).end) / (2 * h);
                const double size = 1 + cycle.jacobian.norm();
                EXPECT_LT((cycle.jacobian.col(i) - slope).norm(),
                          (3 * tolerance() / h + 3 * h * h * size * size) * size);
            }
        }
    }
}

// u'' = -r dominates: the cart changes u'^2/2 + u^2/2 + cubic u^4/4 by a few parts in 1e6 per cycle.
TEST_P(EveryIntegrator, StrongCubicFlightKeepsItsEnergy) {
    constexpr double cubic = 10;
    Oscillator<double> oscillator{.frequency = 2, .gap = 1000, .cubic = cubic};
    const auto energy = [&](const State<double>& x) {
        const double u = x[0] + oscillator.gap;
        return x[1] * x[1] / 2 + u * u / 2 + cubic * u * u * u * u / 4;
    };
    const State<double> start(100 - oscillator.gap, 0);
    const auto cycle = observed(map(oscillator), start);
    ASSERT_EQ(cycle.outcome, Outcome::done);
    EXPECT_FALSE(cycle.touched);
    EXPECT_NEAR(energy(cycle.end) / energy(start), 1, 5e-6 + 200 * tolerance());
    EXPECT_NEAR(cycle.largest_displacement, 100, 2);
}

// One cycle by a Runge-Kutta method in long double, directly from the model's definition.
State<double> by_runge_kutta(const Oscillator<double>& oscillator, const State<double>& start, int steps) {
    using Number = long double;
    const auto slope = [&](Number time, Number position, Number velocity) {
        const Number y = std::sin(Number(oscillator.frequency) * time);
        const Number u = position + Number(oscillator.gap);
        const bool absolute = oscillator.cubic_form == job::CubicForm::absolute;
        const Number r = oscillator.cubic * (absolute ? std::pow(u + y, Number(3)) - y * y * y : u * u * u);
        const Number f =
            oscillator.kelvin_voigt().stiffness * position + oscillator.kelvin_voigt().damping * velocity;
        return oscillator.drive() * y - 2 * oscillator.damping_ratio * velocity - u - r -
               (position > 0 && f > 0 ? f : 0);
    };
    Number x = start[0];
    Number v = start[1];
    const Number h = Number(2) * std::numbers::pi_v<Number> / Number(oscillator.frequency) / steps;
    for (int n = 0; n < steps; ++n) {
        const Number t = n * h;
        const Number a1 = slope(t, x, v);
        const Number v2 = v + h / 2 * a1;
        const Number a2 = slope(t + h / 2, x + h / 2 * v, v2);
        const Number v3 = v + h / 2 * a2;
        const Number a3 = slope(t + h / 2, x + h / 2 * v2, v3);
        const Number v4 = v + h * a3;
        const Number a4 = slope(t + h, x + h * v3, v4);
        x += h / 6 * (v + 2 * v2 + 2 * v3 + v4);
        v += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
    }
    return {static_cast<double>(x), static_cast<double>(v)};
}

TEST_P(EveryIntegrator, AgreesWithRungeKuttaForBothCubicForms) {
    for (const auto form : {job::CubicForm::relative, job::CubicForm::absolute}) {
        for (const double cubic : {1e-6, 0.05, 5.0}) {
            SCOPED_TRACE(cubic);
            auto flight = cubic_rig(cubic, form);
            flight.gap = 100;
            const State<double> far(1.2 - flight.gap, -0.7);
            const auto free = map(flight)(far);
            EXPECT_LT((free.end - by_runge_kutta(flight, far, 4000)).norm(),
                      10 * allowed({.jacobian = free.jacobian}));
            auto soft = cubic_rig(cubic, form);  // elastic: without a jump fixed steps converge
            soft.kelvin_voigt().stiffness = 30;
            soft.kelvin_voigt().damping = 0;
            const State<double> near(-1.5, 0.8);
            const auto struck = map(soft)(near);
            EXPECT_EQ(struck.impacts > 0, true);
            EXPECT_LT((struck.end - by_runge_kutta(soft, near, 40000)).norm(),
                      10 * allowed({.jacobian = struck.jacobian}) + 1e-7);
        }
    }
}

}  // namespace
}  // namespace peterka::trajectory
