// The reference in extended precision: against closed forms of the same motions.
#include "study/taylor_cycle_map.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "observed.hpp"
#include "rig.hpp"
#include "scene/in_precision.hpp"
#include "trajectory/exact_cycle_map.hpp"

namespace peterka::trajectory {
namespace {

using study::TaylorCycleMap;

using Real = long double;
using testing::beam_170mm;
using testing::paper_rig;
using Outcome = Cycle<Real>::Outcome;

Real distance(Real a, Real b) {
    return std::abs(a - b);
}

struct Place {
    double frequency;
    double gap;
};
constexpr std::array<Place, 8> regular_cells{
    {{2.0, 0.0}, {1.3, 1.0}, {1.1, 4.0}, {3.5, 0.3}, {2.75, 0.0}, {0.8, 0.2}, {3.1, 0.0}, {4.2, 0.5}}};

// Two independent methods: closed-form legs with events by bounds, and power series with events by signs.
TEST(TaylorCycleMap, IsTheClosedFormToExtendedPrecisionOnRegularCells) {
    for (const Place& place : regular_cells) {
        const auto rig = paper_rig(beam_170mm, place.frequency, place.gap);
        const ExactCycleMap<double> settling(rig);
        State<double> start = testing::start_at(rig);
        for (int n = 0; n < 1000; ++n) start = settling(start, nullptr).end;

        const auto oscillator = scene::in_precision<Real>(rig);
        const ExactCycleMap<Real> exact(oscillator);
        const TaylorCycleMap taylor(oscillator);
        State<Real> x = start.cast<Real>();
        State<Real> y = x;
        for (int n = 0; n < 20; ++n) {
            const auto expected = testing::observed(exact, x);
            const auto cycle = taylor(y);
            ASSERT_EQ(cycle.outcome, Outcome::done);
            ASSERT_EQ(cycle.impacts, expected.impacts);
            EXPECT_LT((cycle.end - expected.end).norm(), 1e-16L * (1 + expected.end.norm()))
                << place.frequency << " " << n;
            EXPECT_LT(distance(cycle.peak_force, expected.peak_force), 1e-16L * (1 + expected.peak_force));
            if (expected.impacts > 0) {
                EXPECT_LT(distance(cycle.last_touch, expected.last_touch), 1e-16L);
            }
            x = expected.end;
            y = cycle.end;
        }
    }
}

TEST(TaylorCycleMap, IsTheClosedFormFromRandomStartsAtStopsOfAllKinds) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> frequency(0.5, 4.5);
    std::uniform_real_distribution<double> gap(-1, 3);
    std::normal_distribution<double> state(0, 3);
    int impacts = 0;
    for (int n = 0; n < 200; ++n) {
        const double its_gap = gap(random);  // separately: the evaluation order of arguments is unspecified
        auto rig = paper_rig(beam_170mm, frequency(random), its_gap);
        if (n % 4 == 1) rig.kelvin_voigt().damping *= 12;   // overdamped
        if (n % 4 == 2) rig.kelvin_voigt().stiffness = 50;  // soft
        if (n % 4 == 3) rig.kelvin_voigt().damping = 0;     // elastic
        const auto oscillator = scene::in_precision<Real>(rig);
        const double velocity = state(random);
        const State<Real> x(state(random), velocity);
        const auto expected = testing::observed(ExactCycleMap<Real>(oscillator), x);
        const auto cycle = TaylorCycleMap(oscillator)(x);
        impacts += expected.impacts;
        ASSERT_EQ(cycle.outcome, Outcome::done) << n;
        EXPECT_EQ(cycle.impacts, expected.impacts) << n;
        EXPECT_EQ(cycle.touched, expected.touched) << n;
        EXPECT_EQ(cycle.separated, expected.separated) << n;
        const Real rounding = 1e-15L * (1 + expected.jacobian.norm());
        EXPECT_LT((cycle.end - expected.end).norm(), rounding) << n;
        EXPECT_LT(distance(cycle.peak_force, expected.peak_force), rounding * (1 + expected.peak_force)) << n;
    }
    EXPECT_GT(impacts, 150);
}

Oscillator<Real> rigid(Real frequency, Real gap, Real coefficient) {
    return {.damping_ratio = 0.02L,
            .contact = scene::Restitution<Real>{coefficient},
            .frequency = frequency,
            .gap = gap};
}

State<Real> settled(const TaylorCycleMap& map, State<Real> x, int cycles) {
    for (int n = 0; n < cycles; ++n) x = map(x).end;
    return x;
}

TEST(TaylorCycleMap, RigidOneImpactOrbitsHaveTheSpeedsOfTheFormula) {
    struct Orbit {
        Real frequency, gap;
        int cycles;
        Real speed;
    };
    // z = 1/n, r = 0.6, zeta = 0.02: roots of the quadratic equation of the impact speed
    for (const Orbit& orbit : {Orbit{2, 0, 1, 11.841323894932L}, Orbit{2, 0.5L, 1, 10.966655235621L},
                               Orbit{4, 0, 2, 18.951633786639L}}) {
        const TaylorCycleMap map(rigid(orbit.frequency, orbit.gap, 0.6L));
        State<Real> x = settled(map, {-1 - orbit.gap, 0}, 400);
        int impacts = 0;
        Real speed = 0;
        for (int n = 0; n < orbit.cycles; ++n) {
            const auto cycle = map(x);
            x = cycle.end;
            impacts += cycle.impacts;
            if (cycle.impacts > 0) speed = cycle.impact_speed;
        }
        EXPECT_EQ(impacts, 1);
        EXPECT_LT(distance(speed, orbit.speed), 1e-11L) << orbit.frequency;
    }
}

TEST(TaylorCycleMap, AChatterEndsInStickingAndCountsOnce) {
    // pressed for half of each cycle, in which soft rebounds die out
    const TaylorCycleMap map(rigid(0.3L, 0, 0.3L));
    const State<Real> x = settled(map, {-1, 0}, 30);
    const auto cycle = map(x);
    ASSERT_EQ(cycle.outcome, Outcome::done);
    EXPECT_TRUE(cycle.touched);
    EXPECT_TRUE(std::isnan(cycle.peak_force));
    // the motion after sticking depends on the phase of release alone
    EXPECT_LT((map(x + State<Real>(-1e-6L, 1e-6L)).end - cycle.end).norm(), 1e-15L);
    EXPECT_LE(cycle.impacts, 3);

    EXPECT_EQ(TaylorCycleMap(rigid(0.3L, 0, 1 - 1e-9L))({0, 1e-6L}).outcome, Outcome::too_many_events);
}

TEST(TaylorCycleMap, AHammerHeldOnARigidStopIsPressedByTheSprings) {
    const auto oscillator = rigid(0.5L, -3, 0.6L);
    const auto cycle = TaylorCycleMap(oscillator)({0, 0});
    EXPECT_FALSE(cycle.separated);
    EXPECT_EQ(cycle.impacts, 0);
    EXPECT_LT(distance(cycle.peak_force, oscillator.drive() + 3), 1e-17L);
}

TEST(TaylorCycleMap, HuntCrossleyOfExponentOneIsALinearSpring) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> frequency(0.5, 4.5);
    std::uniform_real_distribution<double> gap(-1, 3);
    std::normal_distribution<double> state(0, 3);
    int impacts = 0;
    for (int n = 0; n < 40; ++n) {
        auto rig = paper_rig(beam_170mm, frequency(random), gap(random));
        rig.kelvin_voigt() = {n % 2 == 0 ? 2e4 : 50.0, 0};
        auto linear = scene::in_precision<Real>(rig);
        auto power = linear;
        power.contact = scene::HuntCrossley<Real>{linear.kelvin_voigt().stiffness, 1, 0};
        const State<Real> x(state(random), state(random));
        const auto expected = testing::observed(ExactCycleMap<Real>(linear), x);
        const auto cycle = TaylorCycleMap(power)(x);
        impacts += expected.impacts;
        ASSERT_EQ(cycle.outcome, Outcome::done) << n;
        EXPECT_EQ(cycle.impacts, expected.impacts) << n;
        const Real rounding = 1e-15L * (1 + expected.jacobian.norm());
        EXPECT_LT((cycle.end - expected.end).norm(), rounding) << n;
        EXPECT_LT(distance(cycle.peak_force, expected.peak_force), rounding * (1 + expected.peak_force)) << n;
    }
    EXPECT_GT(impacts, 30);
}

// One impact of a free mass, delta'' = -K delta^n (1 + D delta'), from speed v to w back:
// v/D - ln(1 + D v)/D^2 = -w/D - ln(1 - D w)/D^2, whatever n; and for D = 0 the deepest point by energy.
TEST(TaylorCycleMap, HuntCrossleyImpactLosesWhatItsIntegralSays) {
    constexpr Real stiffness = 1e20L;  // so short an impact that springs and drive contribute nothing
    constexpr Real speed = 20;
    for (const Real exponent : {1.5L, 2.5L}) {
        for (const Real dissipation : {0.0L, 0.02L}) {
            const Oscillator<Real> oscillator{
                .contact = scene::HuntCrossley<Real>{stiffness, exponent, dissipation}, .frequency = 5};
            const auto cycle = TaylorCycleMap(oscillator)({0, speed});
            ASSERT_EQ(cycle.outcome, Outcome::done);
            // back from the end of the cycle along u = a sin(eta tau) + b sin(tau)
            const Real a = oscillator.drive() / (1 - oscillator.drive()) * oscillator.frequency;
            const Real rebound = -a - (cycle.end[1] - a) / std::cos(oscillator.period());
            if (dissipation == 0) {
                EXPECT_LT(distance(rebound, speed), 1e-3L);
                const Real deepest =
                    std::pow((exponent + 1) * speed * speed / (2 * stiffness), 1 / (exponent + 1));
                EXPECT_LT(distance(cycle.peak_force / (stiffness * std::pow(deepest, exponent)), 1), 1e-6L);
            } else {
                const auto side = [dissipation](Real w) {
                    return w / dissipation - std::log(1 + dissipation * w) / (dissipation * dissipation);
                };
                EXPECT_LT(distance(side(speed), side(-rebound)), 1e-2L);
                EXPECT_LT(rebound, 0.8L * speed);
            }
        }
    }
}

TEST(TaylorCycleMap, ASofteningSpringThatGivesWayIsNotFinite) {
    auto oscillator = scene::in_precision<Real>(paper_rig(beam_170mm, 2, 20));
    oscillator.cubic = -0.01L;
    EXPECT_EQ(TaylorCycleMap(oscillator)({-60, 0}).outcome, Outcome::not_finite);
}

// In flight, delta'' = eta^2 y - u - 2 zeta u' - cubic ((u + y)^3 - y^3), by small steps of Runge and Kutta.
TEST(TaylorCycleMap, AnAbsoluteCubicSpringPullsAtTheCartToo) {
    const Oscillator<Real> oscillator{.damping_ratio = 0.1L,
                                      .frequency = 2,
                                      .gap = 100,
                                      .cubic = 0.01L,
                                      .cubic_form = job::CubicForm::absolute};
    const auto slope = [&](Real time, const State<Real>& x) {
        const Real y = std::sin(oscillator.frequency * time);
        const Real u = x[0] + oscillator.gap;
        const Real cubes = (u + y) * (u + y) * (u + y) - y * y * y;
        return State<Real>(
            x[1], oscillator.drive() * y - u - 2 * oscillator.damping_ratio * x[1] - oscillator.cubic * cubes);
    };
    const State<Real> start(-101.5L, 0.7L);
    State<Real> x = start;
    constexpr int steps = 2000;
    const Real h = oscillator.period() / steps;
    for (int n = 0; n < steps; ++n) {
        const Real time = h * n;
        const State<Real> a = slope(time, x);
        const State<Real> b = slope(time + h / 2, x + h / 2 * a);
        const State<Real> c = slope(time + h / 2, x + h / 2 * b);
        const State<Real> d = slope(time + h, x + h * c);
        x += h / 6 * (a + 2 * b + 2 * c + d);
    }
    const auto cycle = TaylorCycleMap(oscillator)(start);
    ASSERT_EQ(cycle.outcome, Outcome::done);
    EXPECT_LT((cycle.end - x).norm(), 1e-11L);
}

}  // namespace
}  // namespace peterka::trajectory
