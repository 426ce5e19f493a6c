// The batched engine with split springs, against its scalar twin cell by cell and against itself.
#include <cmath>

#include "batch_agreement.hpp"
#include "trajectory/split_cycle_map.hpp"

namespace peterka::testing {
namespace {

using batch::BatchedCycleMap;
using batch::Springs;

using testing::paper_cubic;

Comparison compare_split(const scene::Oscillator<double>& rig, const std::vector<BatchCell>& cells, int kicks,
                         int cycles) {
    return compare_with_twin(rig, cells, {kicks, Springs::split}, cycles);
}

// Their steady orbits need no twin.
TEST(BatchSplit, RegularCells) {
    for (const auto& [frequency, gap] : regular_cells) {
        const auto oscillator = cubic_rig(paper_cubic, frequency, gap);
        const int kicks = trajectory::split_steps(oscillator, 7, 1e-6);
        const Comparison c = compare_split(oscillator, {{frequency, gap, start_at(oscillator)}}, kicks, 100);
        expect_agreement(c);
        EXPECT_EQ(c.different_events, 0);
        EXPECT_GE(c.impacts, 40);
        EXPECT_EQ(c.left_to_twin, 0);
    }
}

TEST(BatchSplit, RandomCells) {
    for (const double cubic : {1e-6, 1e-3, 3e-2, -1e-3}) {
        for (const int kicks : {16, 33, 80}) {
            SCOPED_TRACE(::testing::Message() << cubic << " " << kicks);
            const Comparison c =
                compare_split(cubic_rig(cubic), random_cells(7, 200, 0.5, 4.5, 0, 3), kicks, 6);
            expect_agreement(c);
            EXPECT_GT(c.impacts, 1000);
            EXPECT_LT(c.left_to_twin, c.cycles / 20);
        }
    }
}

// Kicks fall into most contacts longer than a step, and into the slow separation from a damped stop.
TEST(BatchSplit, KicksWithinContacts) {
    for (const double contact_damping_ratio : {0.0, 0.2, 0.8}) {
        for (const double stiffness : {10.0, 1e3}) {
            scene::Oscillator<double> rig;
            rig.damping_ratio = 0.02;
            rig.contact =
                scene::KelvinVoigt<double>{stiffness, 2 * contact_damping_ratio * std::sqrt(stiffness)};
            rig.cubic = 1e-2;
            SCOPED_TRACE(::testing::Message() << stiffness << " " << contact_damping_ratio);
            const Comparison c = compare_split(rig, random_cells(8, 200, 0.5, 4.5, -2, 2), 48, 6);
            expect_agreement(c);
            EXPECT_GT(c.impacts, 700);
            // the separation from a soft, damped stop is slow
            EXPECT_LT(c.left_to_twin, c.cycles / 100);
        }
    }
}

// A spring that presses the hammer against the stop: every kick falls into the contact.
TEST(BatchSplit, SustainedContact) {
    const auto rig = cubic_rig(1e-2);
    BatchedCycleMap map(rig, 1, 16, Springs::split);
    map.add(0.6, -3, {1e-4, 0});
    for (int cycle = 0; cycle < 20; ++cycle) map.advance();
    EXPECT_EQ(map.cycle(0).impacts, 0);
    EXPECT_TRUE(map.cycle(0).touched);
    EXPECT_FALSE(map.cycle(0).separated);
    EXPECT_EQ(map.left_to_twin(), 0);
    // the springs' load plus the contribution of the forcing
    EXPECT_NEAR(map.peak_force(0), 3 + 1e-2 * 27 + 0.36, 1e-3);
}

// Second-order convergence (Strang 1968) to the solution of the cubic equation itself.
TEST(BatchSplit, ErrorFallsWithTheSquareOfTheStep) {
    const auto rig = cubic_rig(3e-2);
    const BatchCell cell{1.7, 0.5, {-2.5, 1.0}};
    const auto end = [&](int kicks) {
        BatchedCycleMap map(rig, 1, kicks, Springs::split);
        map.add(cell.frequency, cell.gap, cell.state);
        map.advance();
        EXPECT_EQ(map.cycle(0).impacts, 1);
        return map.state(0);
    };
    const auto fine = end(1024);
    double before = (end(16) - fine).norm();
    for (const int kicks : {32, 64, 128}) {
        const double error = (end(kicks) - fine).norm();
        EXPECT_NEAR(before / error, 4, 0.4) << kicks;
        before = error;
    }
}

TEST(BatchSplit, WhatTheKernelCannotDoIsTheTwins) {
    auto absolute = cubic_rig(1e-3);
    absolute.cubic_form = job::CubicForm::absolute;
    const auto cells = random_cells(9, 20, 0.8, 4.5, 0, 2);
    Comparison c = compare_split(absolute, cells, 16, 2);
    EXPECT_EQ(c.left_to_twin, c.cycles);
    EXPECT_EQ(c.different_events, 0);
    // kicks too far apart for the kernel's series, and springs that lose stability
    c = compare_split(cubic_rig(1e-3), cells, 6, 2);
    EXPECT_EQ(c.left_to_twin, c.cycles);
    c = compare_split(cubic_rig(-0.5), {{2, 1.5, {-1, 0}}}, 16, 1);
    EXPECT_EQ(c.left_to_twin, c.cycles);
    EXPECT_EQ(c.different_events, 0);
}

TEST(BatchSplit, LinearSpringsLeaveTheCubicOut) {
    const auto cells = random_cells(10, 50, 0.8, 4.5, 0, 2);
    BatchedCycleMap with(cubic_rig(1e-3), cells.size());
    BatchedCycleMap without(cubic_rig(0), cells.size());
    for (std::size_t n = 0; n < cells.size(); ++n) {
        with.add(cells[n].frequency, cells[n].gap, cells[n].state);
        without.add(cells[n].frequency, cells[n].gap, cells[n].state);
    }
    with.advance();
    without.advance();
    for (std::size_t n = 0; n < cells.size(); ++n) EXPECT_TRUE(with.state(n) == without.state(n));
}

TEST(BatchSplit, MotionsThatRunAwayAreNotDone) {
    BatchedCycleMap map(cubic_rig(1e-3), 2, 16, Springs::split);
    map.add(2, 0.5, {-1, 0});
    map.add(2, 0.5, {-1e40, 0});
    map.advance();
    EXPECT_EQ(map.cycle(0).outcome, trajectory::Cycle<double>::Outcome::done);
    EXPECT_NE(map.cycle(1).outcome, trajectory::Cycle<double>::Outcome::done);
}

}  // namespace
}  // namespace peterka::testing
