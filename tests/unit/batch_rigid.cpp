// The batched engine with a rigid stop, against its scalar twin cell by cell and cycle by cycle, and against
// closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "batch/cycle_kernel.hpp"
#include "batch/rigid-inl.hpp"
#include "batch_agreement.hpp"
#include "batch_one_cell.hpp"
#include "rigid_rig.hpp"

namespace peterka::testing {
namespace {

using batch::BatchedCycleMap;
using batch::Stop;

class BatchRigid : public ::testing::Test {
  protected:
    ~BatchRigid() override { batch::use_instruction_set(0); }
};

// From grazing to hard, preloaded and not, some sticking to the stop.
std::vector<BatchCell> cells_for_rigid(unsigned seed, std::size_t count, double least_gap) {
    auto cells = random_cells(seed, count, 0.5, 4.5, least_gap, 3);
    for (auto& cell : cells) cell.state[0] = -std::abs(cell.state[0]);
    for (std::size_t n = 0; n < count; n += 13) cells[n].state = {0, 0};
    return cells;
}

void expect_rigid_agreement(const Comparison& c) {
    EXPECT_EQ(c.different_events, c.grazes);
    EXPECT_LE(c.grazes, c.cycles / 1000);
    EXPECT_EQ(c.different_totals, 0);
    EXPECT_LT(c.totals, 1e-11);  // a contact's time is known to rounding over its speed, which is at least 1e-5
    EXPECT_LT(c.state, state_tolerance);
    EXPECT_LT(c.peak_force, 1e-12);
    EXPECT_LT(c.jacobian, jacobian_tolerance);
    EXPECT_LT(c.bound_too_low, 1e-11);
    EXPECT_LT(c.bound_too_high, 0.25);
}

class BatchRigidThorough : public BatchRigid {};

TEST_F(BatchRigidThorough, RandomCells) {
    for (const double r : {0.0, 1e-3, 0.1, 0.32, 0.6, 0.9, 0.99, 1.0}) {
        for (const int steps : {16, 33}) {
            SCOPED_TRACE(::testing::Message() << "r " << r << ", steps " << steps);
            const auto cells = cells_for_rigid(static_cast<unsigned>(steps), 600, steps == 16 ? -0.5 : 0);
            const Comparison c = compare_with_twin(rigid(r, 1, 0, 0.004), cells, steps, 12);
            expect_rigid_agreement(c);
            EXPECT_GT(c.impacts, 3000);
            EXPECT_GT(c.chatters, r > 0 && r < 0.7 ? 40 : -1);
            EXPECT_LT(c.left_to_twin, c.cycles / 50);
        }
    }
}

TEST_F(BatchRigid, RandomRigsWithEachInstructionSet) {
    std::mt19937 random(5);
    const auto between = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    for (int n = 0; n < 12; ++n) {
        const double r = n % 4 == 0 ? std::pow(10, between(-6, -1)) : between(0, 1);
        const double damping_ratio = between(0, n % 3 == 0 ? 0.9 : 0.1);
        SCOPED_TRACE(::testing::Message() << "r " << r << ", damping ratio " << damping_ratio);
        for (const std::int64_t set : batch::instruction_sets()) {
            SCOPED_TRACE(batch::name_of(set));
            batch::use_instruction_set(set);
            auto cells = random_cells(100 + static_cast<unsigned>(n), 200, 0.5, 20, 0, 10);
            for (auto& cell : cells) cell.state[0] = -std::abs(cell.state[0]);
            expect_rigid_agreement(compare_with_twin(rigid(r, 1, 0, damping_ratio), cells, 16, 4));
        }
    }
}

TEST_F(BatchRigid, RigsOfTheirOwn) {
    std::mt19937 random(6);
    const auto between = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    std::vector<OwnRigCell> cells;
    for (const BatchCell& cell : cells_for_rigid(7, 1000, -0.5)) {
        const double r = cells.size() % 9 == 0 ? 0 : between(0, 1);
        cells.push_back({rigid(r, cell.frequency, cell.gap, between(0, 0.3)), cell.state});
    }
    const Comparison c = compare_with_twin(cells, 16, 12);
    expect_rigid_agreement(c);
    EXPECT_GT(c.impacts, 10'000);
    EXPECT_GT(c.chatters, 300);
    EXPECT_LT(c.left_to_twin, c.cycles / 50);
}

// Impacts, chatter and sticking from the beginning need no twin.
TEST_F(BatchRigid, SlowForcing) {
    for (const double r : {0.0, 0.3, 0.6, 0.8}) {
        SCOPED_TRACE(r);
        const std::vector<BatchCell> cells(20, {0.3, 0, {-1, -0.3}});
        const Comparison c = compare_with_twin(rigid(r, 1, 0), cells, BatchedCycleMap::steps_for(0.3), 50);
        expect_rigid_agreement(c);
        EXPECT_EQ(c.different_events, 0);
        EXPECT_EQ(c.left_to_twin, 0);
        EXPECT_GE(c.chatters, r > 0 ? c.cycles * 9 / 10 : 0);
    }
}

// Preloaded: the stop carries the springs and the cart's inertia.
TEST_F(BatchRigid, RestThatNeverEnds) {
    BatchedCycleMap map(rigid(0.6, 1, 0), 1);
    map.add(0.6, -3.0, {-1, 0});
    for (int cycle = 0; cycle < 20; ++cycle) map.advance();
    const auto cycle = map.cycle(0);
    EXPECT_EQ(cycle.end, scene::State<double>::Zero());
    EXPECT_EQ(cycle.jacobian, scene::Jacobian<double>::Zero());
    EXPECT_EQ(cycle.impacts, 0);
    EXPECT_TRUE(cycle.touched);
    EXPECT_FALSE(cycle.separated);
    EXPECT_NEAR(map.peak_force(0), 3 + 0.36, 1e-15);
    EXPECT_EQ(map.left_to_twin(), 0);
}

// Orbits 1/n in closed form, also in long double.
TEST_F(BatchRigid, SingleImpactOrbitsHaveTheSpeedOfTheFormula) {
    struct Case {
        double frequency, gap, speed;
    };
    for (const auto& [frequency, gap, speed] :
         {Case{2, 0, 11.841323894932}, Case{2, 0.5, 10.966655235621}, Case{4, 0, 18.951633786639}}) {
        trajectory::Recorder<long double> truth;
        const trajectory::RigidExactMap<long double> precise(rigid<long double>(0.6, frequency, gap));
        scene::State<long double> x(-1 - gap, 0);
        for (int cycle = 0; cycle < 2000; ++cycle) x = precise(x, cycle < 1998 ? nullptr : &truth).end;
        const auto exact = static_cast<double>(truth.totals().impact_speed);
        EXPECT_NEAR(exact, speed, 1e-11);
        for (const std::int64_t set : batch::instruction_sets()) {
            SCOPED_TRACE(batch::name_of(set));
            batch::use_instruction_set(set);
            BatchedCycleMap map(rigid(0.6, 1, 0), 1);
            map.add(frequency, gap, {-1 - gap, 0});
            double largest = 0;
            for (int cycle = 0; cycle < 2000; ++cycle) {
                map.advance();
                if (cycle >= 1998) largest = std::max(largest, map.totals(0).impact_speed);
            }
            EXPECT_NEAR(largest, exact, 1e-13 * exact);
            EXPECT_EQ(map.left_to_twin(), 0);
        }
    }
}

TEST_F(BatchRigid, StartsInTheStopAndNumbersThatAreNoneAreTheTwins) {
    using Outcome = trajectory::Cycle<double>::Outcome;
    BatchedCycleMap map(rigid(0.6, 1, 0), 4);
    map.add(2, 0.5, {-1, 0});
    map.add(2, 0.5, {0.1, 0});
    map.add(2, 0.5, {std::nan(""), 0});
    map.add(2, 0.5, {0, 1});
    map.advance();
    EXPECT_EQ(map.cycle(0).outcome, Outcome::done);
    EXPECT_EQ(map.cycle(1).outcome, Outcome::inside_stop);
    EXPECT_EQ(map.cycle(2).outcome, Outcome::not_finite);
    EXPECT_EQ(map.cycle(3).outcome, Outcome::done);
    EXPECT_EQ(map.left_to_twin(), 3);
}

// A hop whose delta = c1 t + c2 t^2 + c3 t^3 has its next root soon after, 1.22 times as late: the jerk has
// nearly used up what presses, and Newton's method is slow, or leads to the other root, unless it starts with
// both.
TEST(BatchRigidHop, IsFoundEvenIfItHardlyReturns) {
    for (const double length : {1e-4, 1e-3}) {
        constexpr double eta = 4;
        constexpr double phase = 2.5;
        const double third = eta * eta * eta * std::cos(phase) / 6;
        const double second = -third * length / 0.45;
        const double speed = second * length + third * length * length;
        const double gap = eta * eta * std::sin(phase) - 2 * second;
        const OneCell cell(rigid(0.5, eta, gap, 0), 16);
        const lanes::Moments start = moments({0, -speed}, phase);
        const lanes::V fourth = lanes::Flight(cell, start).fourth_derivative_bound(lanes::all(cell.swing));
        const lanes::ShortHop hop = lanes::short_hop(cell, start, fourth, lanes::all(1));
        ASSERT_TRUE(lanes::everywhere(hop.sure)) << length;
        const lanes::Moments end = lanes::Flight(cell, start).at(hop.time);
        EXPECT_NEAR(one_of(end.delta), 0, 1e-14);
        EXPECT_NEAR(one_of(end.velocity), one_of(hop.speed), 1e-13);
        EXPECT_NEAR(one_of(hop.time), length, 0.02 * length);
    }
}

}  // namespace
}  // namespace peterka::testing
