// Kicks by the cubic spring between exact legs (Strang splitting):
// order, Jacobian, and agreement with a Taylor method.
#include "trajectory/split_cycle_map.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "split_orbits.hpp"
#include "trajectory/exact_cycle_map.hpp"
#include "trajectory/lasting_contact.hpp"

namespace peterka::trajectory {
namespace {

using job::CubicForm;
using testing::cubic_rig;
using testing::observed;
using testing::paper_cubic;
using testing::Place;
using testing::regular_cells;
using testing::settle;
using testing::settled_oracle;
using testing::TaylorOracle;

TEST(SplitCycleMap, WithoutCubicIsTheExactMap) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> frequency(0.5, 4.5);
    std::uniform_real_distribution<double> gap(-1, 3);
    std::normal_distribution<double> state(0, 3);
    int impacts = 0;
    for (int n = 0; n < 200; ++n) {
        const auto form = n % 2 == 0 ? CubicForm::relative : CubicForm::absolute;
        const auto oscillator = cubic_rig({frequency(random), gap(random)}, 0, form);
        const State<double> x(state(random), state(random));
        const auto exact = observed(ExactCycleMap<double>(oscillator), x);
        const auto one_step = observed(SplitCycleMap<double>(oscillator, 1), x);
        EXPECT_EQ(one_step.end, exact.end) << n;
        EXPECT_EQ(one_step.peak_force, exact.peak_force) << n;
        EXPECT_EQ(one_step.largest_displacement, exact.largest_displacement) << n;
        const auto steps = observed(SplitCycleMap<double>(oscillator, 12), x);
        impacts += exact.impacts;
        EXPECT_EQ(steps.pattern, exact.pattern) << n;
        EXPECT_EQ(steps.impacts, exact.impacts) << n;
        // errors of the start grow with the Jacobian
        const double rounding = 1e-13 * (1 + exact.jacobian.norm());
        EXPECT_LT((steps.end - exact.end).norm(), rounding) << n;
        EXPECT_NEAR(steps.peak_force, exact.peak_force, rounding * (1 + exact.peak_force)) << n;
    }
    EXPECT_GT(impacts, 150);
}

TEST(SplitCycleMap, IsSecondOrderInTheStep) {
    for (const auto form : {CubicForm::relative, CubicForm::absolute}) {
        for (const Place& place : {Place{2.0, 0.0}, Place{2.75, 0.0}, Place{4.2, 0.5}}) {
            const auto oscillator = cubic_rig(place, 1e3 * paper_cubic, form);
            const auto near = settle(SplitCycleMap<double>(oscillator, 256)).point;
            TaylorOracle oracle(oscillator, near);
            oracle.advance(100);
            std::array<State<double>, 2> points;  // an orbit of two cycles has two points
            for (State<double>& point : points) {
                oracle.advance(1);
                point = {static_cast<double>(oracle.delta()), static_cast<double>(oracle.velocity())};
            }
            double coarse = 0;
            for (const int steps : {64, 128, 256}) {
                const auto orbit = settle(SplitCycleMap<double>(oscillator, steps), near);
                const double error =
                    std::min((orbit.point - points[0]).norm(), (orbit.point - points[1]).norm());
                if (steps > 64) {
                    EXPECT_NEAR(coarse / error, 4, 0.4) << place.frequency << " " << steps;
                }
                coarse = error;
            }
        }
    }
}

// What an observer is shown a quarter into each stretch.
class Quarters : public Observer<double> {
  public:
    void stretch(Phase, double from, double length, const StateAt& state_at) override {
        seen.emplace_back(from + length / 4, state_at(length / 4));
    }
    void touch(double) override {}
    void rest(std::int64_t) override {}
    void leave(const ImpactRecord<double>&) override {}
    std::vector<std::pair<double, State<double>>> seen;  // tau, state
};

// Largest error of the velocity that is shown in a cycle of so many steps.
double error_shown(const Oscillator<double>& oscillator, const State<double>& x, int steps) {
    Quarters quarters;
    Recorder<double> recorder(Detail::contacts, quarters);
    const auto cycle = SplitCycleMap<double>(oscillator, steps)(x, &recorder);
    EXPECT_EQ(cycle.outcome, Cycle<double>::Outcome::done);
    EXPECT_EQ(std::ssize(quarters.seen), steps);
    const SplitCycleMap<double> fine(oscillator, 20'000);
    double largest = 0;
    for (const auto& [tau, state] : quarters.seen)
        largest = std::max(largest, std::abs(state[1] - fine.part(x, 0, tau).end[1]));
    return largest;
}

// Also between kicks, of which half is there too early, or is missing.
TEST(SplitCycleMap, WhatAnObserverSeesIsOfSecondOrderInTheStep) {
    const auto oscillator = cubic_rig({1.7, 60}, 2e-5, CubicForm::relative);
    const State<double> x(-65, 3);
    const double error = error_shown(oscillator, x, 80);
    EXPECT_LT(error, 0.02);
    EXPECT_NEAR(error / error_shown(oscillator, x, 160), 4, 0.4);
}

TEST(SplitCycleMap, CyclesAgreeWithTaylorIntegrationFromRandomStarts) {
    std::mt19937 random(17);
    std::uniform_real_distribution<double> frequency(0.6, 4.0);
    std::uniform_real_distribution<double> gap(-0.5, 2);
    std::uniform_real_distribution<double> speed(-3, 3);
    int impacts = 0;
    for (int n = 0; n < 60; ++n) {
        const auto form = n % 2 == 0 ? CubicForm::relative : CubicForm::absolute;
        auto oscillator = cubic_rig({frequency(random), gap(random)}, 0.02, form);
        if (n % 4 == 1) oscillator.kelvin_voigt().damping *= 12;   // an overdamped stop
        if (n % 4 == 2) oscillator.kelvin_voigt().stiffness = 50;  // a soft one
        if (n % 4 == 3) oscillator.cubic = -0.004;                 // a softening spring
        if (n % 5 == 0) oscillator.kelvin_voigt().damping = 0;     // an elastic stop
        const State<double> start(-std::abs(speed(random)), speed(random));
        const auto cycle = observed(SplitCycleMap<double>(oscillator, 512), start);
        TaylorOracle expected(oscillator, start);
        expected.advance(1);
        ASSERT_EQ(cycle.outcome, Cycle<double>::Outcome::done);
        impacts += cycle.impacts;
        EXPECT_EQ(cycle.impacts, expected.impacts()) << n;
        const double tolerance = 2e-5 * (1 + cycle.jacobian.norm());
        EXPECT_NEAR(cycle.end[0], static_cast<double>(expected.delta()), tolerance) << n;
        EXPECT_NEAR(cycle.end[1], static_cast<double>(expected.velocity()), tolerance) << n;
        const auto force = static_cast<double>(expected.peak_force());
        EXPECT_NEAR(cycle.peak_force, force, tolerance * (1 + force)) << n;
    }
    EXPECT_GT(impacts, 50);
}

TEST(SplitCycleMap, JacobianIsTheDerivative) {
    constexpr double h = 1e-6;
    std::mt19937 random(7);
    std::uniform_real_distribution<double> frequency(0.5, 4.5);
    std::uniform_real_distribution<double> gap(-1, 3);
    std::normal_distribution<double> state(0, 3);
    int compared = 0;
    for (int n = 0; n < 300; ++n) {
        const auto form = n % 2 == 0 ? CubicForm::relative : CubicForm::absolute;
        const SplitCycleMap<double> map(cubic_rig({frequency(random), gap(random)}, 0.03, form), 12);
        const State<double> x(state(random), state(random));
        const auto cycle = map(x);
        Jacobian<double> expected;
        bool smooth = true;
        for (int i = 0; i < 2; ++i) {
            State<double> shift = State<double>::Zero();
            shift[i] = h;
            const auto up = map(x + shift);
            const auto down = map(x - shift);
            smooth &= up.pattern == down.pattern && up.pattern == cycle.pattern;
            expected.col(i) = (up.end - down.end) / (2 * h);
        }
        const double size = cycle.jacobian.norm();
        if (!smooth || size > 50) continue;  // near grazing the differences themselves are inaccurate
        ++compared;
        EXPECT_LT((cycle.jacobian - expected).norm(), 1e-4 * (1 + size)) << n << " " << x.transpose();
    }
    EXPECT_GT(compared, 200);
}

TEST(SplitCycleMap, ThePapersCubicShiftsPeakForceAsTaylorIntegrationSays) {
    for (const Place& place : regular_cells) {
        const auto linear = settle(ExactCycleMap<double>(cubic_rig(place, 0)));
        const auto oscillator = cubic_rig(place, paper_cubic);
        const auto orbit = settle(SplitCycleMap<double>(oscillator, 64));
        const auto expected = settled_oracle(oscillator, orbit.point);
        const auto force = static_cast<double>(expected.peak_force());
        EXPECT_EQ(orbit.impacts, expected.impacts());
        EXPECT_NEAR(orbit.peak_force / force, 1, 3e-10) << place.frequency;
        const double shift = std::abs(orbit.peak_force / linear.peak_force - 1);
        EXPECT_GT(shift, 2e-7) << place.frequency;
        EXPECT_LT(shift, 1.1e-4) << place.frequency;
    }
}

TEST(SplitCycleMap, KeepsThreeImpactsInTwoCycles) {
    for (const auto form : {CubicForm::relative, CubicForm::absolute}) {
        for (const int steps : {4, 14, 21, 33, 100}) {
            const auto orbit = settle(SplitCycleMap<double>(cubic_rig({3.1, 0.0}, paper_cubic, form), steps));
            EXPECT_EQ(orbit.impacts, 6) << steps;
        }
    }
}

TEST(SplitCycleMap, SustainedContactCarriesTheStaticLoadOfTheCubic) {
    // a spring that presses the hammer against the stop; the cubic adds cubic * |gap|^3 to the load
    auto oscillator = cubic_rig({0.5, -3.0}, 0.01);
    auto linear = oscillator;
    linear.cubic = 0;
    const LinearContact<double> exact(linear);
    const auto pressed = settle(SplitCycleMap<double>(oscillator, 16), exact.steady());
    const auto expected = settled_oracle(oscillator, pressed.point, 1);
    EXPECT_EQ(pressed.impacts, 0);
    const auto force = static_cast<double>(expected.peak_force());
    EXPECT_NEAR(pressed.peak_force / force, 1, 1e-6);
    EXPECT_NEAR(pressed.peak_force - exact.steady_force(), 0.01 * 27, 1e-3);
}

}  // namespace
}  // namespace peterka::trajectory
