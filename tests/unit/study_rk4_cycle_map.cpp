// Runge-Kutta of order 4 with a fixed step: with located events
// it keeps its order, without them it drops to order one.
#include "study/rk4_cycle_map.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "observed.hpp"
#include "rig.hpp"
#include "trajectory/exact_cycle_map.hpp"

namespace peterka::trajectory {
namespace {

using study::Rk4CycleMap;
using study::Rk4Events;

// A stop soft enough for coarse steps, struck once a cycle.
Oscillator<double> soft_stop() {
    return {.damping_ratio = 0.02, .contact = scene::KelvinVoigt<double>{400, 8}, .frequency = 2, .gap = 0.5};
}

State<double> settled(const Oscillator<double>& oscillator) {
    const ExactCycleMap<double> exact(oscillator);
    State<double> x(-1.5, 0);
    for (int n = 0; n < 2000; ++n) x = exact(x, nullptr).end;
    return x;
}

struct Errors {
    double end;
    double peak_force;
    double impact_time;
};

Errors errors_of(int steps, Rk4Events events) {
    const auto oscillator = soft_stop();
    const State<double> x = settled(oscillator);
    const auto expected = testing::observed(ExactCycleMap<double>(oscillator), x);
    const auto cycle = Rk4CycleMap(oscillator, steps, events)(x, true);
    EXPECT_EQ(cycle.outcome, Cycle<double>::Outcome::done);
    EXPECT_EQ(cycle.impacts, expected.impacts);
    return {(cycle.end - expected.end).norm(), std::abs(cycle.peak_force / expected.peak_force - 1),
            std::abs(cycle.last_touch - expected.last_touch)};
}

TEST(Rk4CycleMap, HasOrderFourWithEvents) {
    const Errors coarse = errors_of(1000, Rk4Events::located);
    const Errors fine = errors_of(8000, Rk4Events::located);
    EXPECT_NEAR(std::log2(coarse.end / fine.end) / 3, 4, 0.3);
    EXPECT_NEAR(std::log2(coarse.peak_force / fine.peak_force) / 3, 4, 0.5);
    EXPECT_LT(fine.peak_force, 1e-10);
    EXPECT_LT(fine.impact_time, 1e-12);
}

// The error at a single step count depends on where the event falls within its step: a mean over many counts.
double mean_error_without_events(int about) {
    double sum = 0;
    constexpr int counts = 40;
    for (int n = 0; n < counts; ++n) sum += errors_of(about + n * about / 200, Rk4Events::ignored).end;
    return sum / counts;
}

TEST(Rk4CycleMap, HasOrderOneWithoutEvents) {
    const double coarse = mean_error_without_events(2000);
    const double fine = mean_error_without_events(32000);
    EXPECT_NEAR(std::log2(coarse / fine) / 4, 1, 0.25);
    EXPECT_GT(fine, 1e4 * errors_of(32000, Rk4Events::located).end);
}

TEST(Rk4CycleMap, JacobianIsThatOfTheExactMap) {
    const auto oscillator = soft_stop();
    const State<double> x = settled(oscillator);
    const auto expected = ExactCycleMap<double>(oscillator)(x, nullptr).jacobian;
    EXPECT_LT((Rk4CycleMap(oscillator, 8000, Rk4Events::located)(x, false).jacobian - expected).norm(), 1e-8);
}

TEST(Rk4CycleMap, StepsTooLongForTheStopLeaveTheRangeOfNumbers) {
    const auto oscillator =
        testing::paper_rig(testing::beam_170mm, 0.5, -1);  // pressed: contact for the whole cycle
    State<double> x(0.1, 0);
    const Rk4CycleMap map(oscillator, 100, Rk4Events::located);
    auto outcome = Cycle<double>::Outcome::done;
    for (int n = 0; n < 50 && outcome == Cycle<double>::Outcome::done; ++n) {
        const auto cycle = map(x, false);
        outcome = cycle.outcome;
        x = cycle.end;
    }
    EXPECT_NE(outcome, Cycle<double>::Outcome::done);
}

}  // namespace
}  // namespace peterka::trajectory
