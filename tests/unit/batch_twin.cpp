// The batched engine against its scalar twin, cell by cell and cycle by cycle.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "batch_agreement.hpp"

namespace peterka::testing {
namespace {

scene::Oscillator<double> rig_with(double stiffness, double contact_damping_ratio, double damping_ratio) {
    scene::Oscillator<double> rig;
    rig.damping_ratio = damping_ratio;
    rig.contact = scene::KelvinVoigt<double>{stiffness, 2 * contact_damping_ratio * std::sqrt(stiffness)};
    return rig;
}

TEST(BatchTwin, RegularCells) {
    std::vector<BatchCell> cells;
    for (const auto& [frequency, gap] : regular_cells) {
        const auto start = start_at(paper_rig(beam_170mm, frequency, gap));
        for (int copy = 0; copy < 3; ++copy) cells.push_back({frequency, gap, start});
    }
    const Comparison c = compare_with_twin(paper_rig(beam_170mm, 1, 0), cells, 16, 200);
    expect_agreement(c);
    EXPECT_EQ(c.different_events, 0);
    EXPECT_GT(c.impacts, 3500);
    EXPECT_LT(c.left_to_twin, c.cycles / 1000);
}

TEST(BatchTwin, RandomCellsOfTheWindow) {
    const auto rig = paper_rig(beam_170mm, 1, 0);
    for (const int steps : {16, 21, 33}) {
        SCOPED_TRACE(steps);
        const Comparison c =
            compare_with_twin(rig, random_cells(static_cast<unsigned>(steps), 1500, 0.5, 4.5, 0, 5), steps, 12);
        expect_agreement(c);
        EXPECT_GT(c.impacts, 10'000);
        EXPECT_LT(c.left_to_twin, c.cycles / 100);
    }
}

// Fewer steps flag more of them; the events must be identical.
TEST(BatchTwin, FewSteps) {
    const auto rig = paper_rig(beam_170mm, 1, 0);
    for (const int steps : {10, 12, 14}) {
        SCOPED_TRACE(steps);
        const double least = 8.01 / steps;
        const Comparison c = compare_with_twin(
            rig, random_cells(static_cast<unsigned>(steps), 1000, least, 4.5, -1, 5), steps, 6);
        expect_agreement(c);
        EXPECT_GT(c.impacts, 3000);
    }
}

TEST(BatchTwin, RandomRigs) {
    std::mt19937 random(5);
    const auto between = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    for (int n = 0; n < 24; ++n) {
        const double stiffness = std::pow(10, between(1, 9));
        const double contact_damping_ratio = n % 4 == 0 ? between(0, 5) : between(0, 0.95);
        const auto rig =
            rig_with(stiffness, n % 6 == 1 ? 0 : contact_damping_ratio, between(0, n % 3 == 0 ? 0.9 : 0.1));
        SCOPED_TRACE(::testing::Message() << "stiffness " << stiffness << ", contact damping ratio "
                                          << contact_damping_ratio << ", damping ratio " << rig.damping_ratio);
        const int steps = n % 2 == 0 ? 16 : 33;
        expect_agreement(compare_with_twin(
            rig, random_cells(100 + static_cast<unsigned>(n), 300, 0.5, 20, -2, 10), steps, 4));
    }
}

TEST(BatchTwin, StepsFollowFromTheFrequency) {
    using batch::BatchedCycleMap;
    EXPECT_EQ(BatchedCycleMap::steps_for(0.8), 10);
    EXPECT_EQ(BatchedCycleMap::steps_for(0.79), 16);
    EXPECT_EQ(BatchedCycleMap::steps_for(0.5), 16);
    EXPECT_EQ(BatchedCycleMap::steps_for(0.3), 32);
}

// Slow forcing uses finer grids; slower still, or resonant, is left to the twin.
TEST(BatchTwin, SlowForcing) {
    const auto rig = paper_rig(beam_170mm, 1, 0);
    for (const double frequency : {0.25, 0.12, 0.05}) {
        SCOPED_TRACE(frequency);
        const auto cells = random_cells(17, 100, frequency, 2 * frequency, -0.01, 0.1);
        const Comparison c = compare_with_twin(rig, cells, batch::BatchedCycleMap::steps_for(frequency), 2);
        expect_agreement(c);
        EXPECT_LT(c.left_to_twin, c.cycles / 10);
    }
    const auto too_slow = random_cells(18, 20, 0.05, 0.06, -0.01, 0.1);
    const Comparison c = compare_with_twin(rig, too_slow, 16, 2);
    EXPECT_EQ(c.left_to_twin, c.cycles);
    EXPECT_EQ(c.different_events, 0);
}

TEST(BatchTwin, DampedRigWithoutStopDamping) {
    expect_agreement(compare_with_twin(rig_with(2e4, 0, 0.02), random_cells(3, 400, 0.5, 4.5, -1, 3), 16, 8));
}

TEST(BatchTwin, NumbersThatAreNoneStayTheirOwn) {
    const auto rig = paper_rig(beam_170mm, 1, 0);
    batch::BatchedCycleMap map(rig, 3);
    map.add(2, 0.5, {-1, 0});
    map.add(2, 0.5, {std::nan(""), 0});
    map.add(2, 0.5, {1e200, 1e200});
    map.advance();
    EXPECT_EQ(map.cycle(0).outcome, trajectory::Cycle<double>::Outcome::done);
    EXPECT_EQ(map.cycle(1).outcome, trajectory::Cycle<double>::Outcome::not_finite);
    EXPECT_NE(map.cycle(2).outcome, trajectory::Cycle<double>::Outcome::done);
}

}  // namespace
}  // namespace peterka::testing
