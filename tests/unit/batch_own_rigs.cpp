// Cells with individual rigs in one batch, against the
// scalar twin of each, and independence of the other cells.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "batch/cycle_kernel.hpp"
#include "batch_agreement.hpp"

namespace peterka::testing {
namespace {

using batch::BatchedCycleMap;
using batch::Springs;

// Unrelated springs, dampers and stops; cubic: the largest cubic stiffness.
std::vector<OwnRigCell> cells_with_rigs(unsigned seed, std::size_t count, double cubic) {
    std::mt19937 random(seed);
    const auto between = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    std::vector<OwnRigCell> cells;
    for (const BatchCell& cell : random_cells(seed, count, 0.5, 8, -1, 5)) {
        OwnRigCell own{{}, cell.state};
        const double stiffness = std::pow(10, between(1.5, 8));
        own.oscillator.damping_ratio = cells.size() % 3 == 0 ? between(0, 0.8) : between(0, 0.05);
        own.oscillator.contact =
            scene::KelvinVoigt<double>{stiffness, 2 * between(0, 0.9) * std::sqrt(stiffness)};
        own.oscillator.frequency = cell.frequency;
        own.oscillator.gap = cell.gap;
        own.oscillator.cubic = between(-cubic / 10, cubic);
        cells.push_back(own);
    }
    return cells;
}

// All contacts are treated as of arbitrary length, with the release known to 1e-12 of the contact's period;
// the force falls there with kappa, and so does the flow's slope.
void expect_agreement_of_own(Comparison c) {
    EXPECT_LT(c.jacobian, 1e-9);
    c.jacobian = 0;
    expect_agreement(c);
}

TEST(BatchOwnRigs, LinearSprings) {
    for (const int steps : {16, 33}) {
        SCOPED_TRACE(steps);
        const Comparison c =
            compare_with_twin(cells_with_rigs(static_cast<unsigned>(steps), 2000, 0), steps, 12);
        expect_agreement_of_own(c);
        EXPECT_GT(c.impacts, 10'000);
        EXPECT_LT(c.left_to_twin, c.cycles / 50);
    }
}

TEST(BatchOwnRigs, CubicSprings) {
    for (const int kicks : {33, 80}) {
        SCOPED_TRACE(kicks);
        const Comparison c = compare_with_twin(cells_with_rigs(static_cast<unsigned>(kicks), 600, 1e-3),
                                               {kicks, Springs::split}, 6);
        expect_agreement_of_own(c);
        EXPECT_GT(c.impacts, 2000);
        EXPECT_LT(c.left_to_twin, c.cycles / 20);
    }
}

// A non-oscillating stop is left to the twin, in any batch.
TEST(BatchOwnRigs, StopsThatDoNotSwing) {
    auto cells = cells_with_rigs(5, 60, 0);
    for (std::size_t n = 0; n < cells.size(); n += 2) {
        auto& stop = cells[n].oscillator.kelvin_voigt();
        stop.damping = 2.5 * std::sqrt(stop.stiffness);
    }
    const Comparison c = compare_with_twin(cells, 16, 6);
    expect_agreement_of_own(c);
    EXPECT_GE(c.left_to_twin, c.cycles / 2);
}

// Alone, in changing company, and with each instruction set of the same arithmetic.
TEST(BatchOwnRigs, ACellDependsOnItselfAlone) {
    for (const Springs springs : {Springs::linear, Springs::split}) {
        const auto cells = cells_with_rigs(11, 90, springs == Springs::split ? 1e-3 : 0);
        BatchedCycleMap together(16, 33, springs);
        for (const OwnRigCell& cell : cells) together.add(cell.oscillator, cell.state);
        together.remove(3);  // the last one takes its slot
        BatchedCycleMap others(1, 33, springs);
        others.add(cells[5].oscillator, cells[5].state);
        together.remove(5);
        const std::string_view arithmetic = batch::arithmetic();
        for (int cycle = 0; cycle < 3; ++cycle) together.advance();
        for (int cycle = 0; cycle < 3; ++cycle) others.advance();
        const auto expect_as_alone = [&](const BatchedCycleMap& map, std::size_t slot, std::size_t cell) {
            for (const std::int64_t set : batch::instruction_sets()) {
                batch::use_instruction_set(set);
                if (batch::arithmetic() == arithmetic) {
                    BatchedCycleMap alone(1, 33, springs);
                    alone.add(cells[cell].oscillator, cells[cell].state);
                    for (int cycle = 0; cycle < 3; ++cycle) alone.advance();
                    EXPECT_EQ(alone.state(0), map.state(slot)) << cell;
                    EXPECT_EQ(alone.cycle(0).jacobian, map.cycle(slot).jacobian) << cell;
                    EXPECT_EQ(alone.cycle(0).pattern, map.cycle(slot).pattern) << cell;
                    EXPECT_EQ(alone.peak_force(0), map.peak_force(slot)) << cell;
                }
                batch::use_instruction_set(0);
            }
        };
        expect_as_alone(together, 3, 89);
        expect_as_alone(together, 5, 88);
        expect_as_alone(together, 50, 50);
        expect_as_alone(others, 0, 5);
    }
}

}  // namespace
}  // namespace peterka::testing
