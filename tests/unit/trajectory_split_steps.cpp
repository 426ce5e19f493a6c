// The number of kicks per cycle that a tolerance requires, and its relation to the error.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "split_orbits.hpp"
#include "trajectory/split_cycle_map.hpp"
#include "trajectory/split_error.hpp"

namespace peterka::trajectory {
namespace {

using job::CubicForm;
using testing::cubic_rig;
using testing::paper_cubic;
using testing::Place;
using testing::regular_cells;
using testing::settle;
using testing::settled_oracle;

TEST(SplitStepsThorough, KeepTheErrorOfPeakForceBelowTheTolerance) {
    int fit = 0;
    for (const auto form : {CubicForm::relative, CubicForm::absolute}) {
        for (const double stronger : {1.0, 1e3, 1e5}) {
            for (const Place& place : regular_cells) {
                const auto oscillator = cubic_rig(place, stronger * paper_cubic, form);
                // strong cubics have several stable orbits: all start near the same one
                const auto guess = settle(SplitCycleMap<double>(oscillator, 128));
                if (guess.impacts == 0) continue;
                const auto expected = settled_oracle(oscillator, guess.point);
                const auto force = static_cast<double>(expected.peak_force());
                for (const double tolerance : {1e-3, 1e-6, 1e-9}) {
                    const int steps = split_steps(oscillator, guess.largest_displacement, tolerance);
                    if (steps == 0) continue;
                    ++fit;
                    const auto orbit = settle(SplitCycleMap<double>(oscillator, steps), guess.point);
                    EXPECT_LT(std::abs(orbit.peak_force / force - 1), tolerance)
                        << place.frequency << " " << stronger << " " << steps;
                }
            }
        }
    }
    EXPECT_GT(fit, 40);
}

TEST(SplitSteps, GrowWithTheCubicAndEndWhereSplittingIsNotFit) {
    auto oscillator = cubic_rig({2.0, 0.5}, 0);
    EXPECT_EQ(split_steps(oscillator, 7, 1e-9), 1);
    oscillator.cubic = paper_cubic;
    const int weak = split_steps(oscillator, 7, 1e-9);
    EXPECT_GT(weak, 8);
    EXPECT_LT(weak, 128);
    EXPECT_GT(split_steps(oscillator, 14, 1e-9), weak);
    EXPECT_LT(split_steps(oscillator, 7, 1e-6), weak);
    oscillator.cubic = 1e5 * paper_cubic;
    EXPECT_EQ(split_steps(oscillator, 7, 1e-9), 0);
    oscillator.cubic = -0.01;  // unstable beyond |u| = 10
    EXPECT_EQ(split_steps(oscillator, 7, 1e-2), 0);
    EXPECT_EQ(SplitCycleMap<double>(oscillator, 0)({-1, 0}).outcome, Cycle<double>::Outcome::solver_failed);
}

TEST(SplitSteps, AreFewDifferentNumbers) {
    std::set<int> numbers;
    for (int steps = 1; steps <= most_split_steps; ++steps) {
        const int rounded = rounded_split_steps(steps);
        numbers.insert(rounded);
        EXPECT_GE(rounded, steps);
        EXPECT_LE(rounded, steps <= 64 ? steps + 15 : steps * 3 / 2);
        EXPECT_EQ(rounded_split_steps(rounded), rounded);
    }
    EXPECT_EQ(numbers.size(), 11U);
    EXPECT_EQ(*numbers.begin(), fewest_split_steps);
    EXPECT_EQ(*numbers.rbegin(), most_split_steps);
}

TEST(SplitError, TellsTheErrorByHalvingTheStep) {
    for (const Place& place : {Place{3.1, 0.0}, Place{4.2, 0.5}, Place{3.5, 0.3}}) {
        const auto oscillator = cubic_rig(place, 1e3 * paper_cubic);
        const SplitCycleMap<double> map(oscillator, 32);
        const auto orbit = settle(map);
        const auto expected = settled_oracle(oscillator, orbit.point, 100);
        const double error = std::abs(orbit.peak_force / static_cast<double>(expected.peak_force()) - 1);
        const auto told = split_error(map, orbit.point, 4, 400);
        ASSERT_TRUE(told.comparable);
        EXPECT_NEAR(told.peak_force / error, 1, 0.15) << place.frequency;
        EXPECT_GT(told.end.norm(), 0);
    }
}

TEST(SplitError, OfASingleCycleIsThatOfTheCycleItself) {
    const auto oscillator = cubic_rig({3.1, 0.0}, 1e3 * paper_cubic);
    const SplitCycleMap<double> map(oscillator, 32);
    const State<double> start = testing::start_at(oscillator);
    const State<double> difference =
        (map(start).end - SplitCycleMap<double>(oscillator, 64)(start).end).cwiseAbs();
    ASSERT_GT(difference.minCoeff(), 1e-9);
    const auto told = split_error(map, start, 1);
    EXPECT_NEAR(told.end[0], 4.0 / 3 * difference[0], 1e-15);
    EXPECT_NEAR(told.end[1], 4.0 / 3 * difference[1], 1e-15);
    Recorder<double> coarse;
    Recorder<double> fine;
    static_cast<void>(map(start, &coarse));
    static_cast<void>(SplitCycleMap<double>(oscillator, 64)(start, &fine));
    const double forces = coarse.totals().peak_force() / fine.totals().peak_force() - 1;
    ASSERT_GT(std::abs(forces), 1e-10);
    EXPECT_NEAR(told.peak_force, 4.0 / 3 * std::abs(forces), 1e-15);
}

}  // namespace
}  // namespace peterka::trajectory
