// Motions that cells learn from the cells beside them, on the 170 mm rig, where 1/2 and no impact coexist.
#include "attractors/known_motions.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "attractors/start_sequence.hpp"
#include "regime/steady_state.hpp"
#include "rig.hpp"

namespace peterka::attractors {
namespace {

using cell::Regime;
using Pairs = std::vector<std::pair<std::int64_t, Regime>>;

constexpr KnownMotion without_impact{.regime = Regime::no_impact, .period = 1};

job::Job grid(std::int64_t columns, std::int64_t rows) {
    job::Job job = testing::job_170mm(0);
    job.columns = {3, 3.04, columns};
    job.rows = {1.5, 1.52, rows};
    job.starts.count = 100;
    return job;
}

// The 1/2 of a cell.
KnownMotion one_impact(const scene::Scene& scene, std::int64_t row, std::int64_t column) {
    const scene::Cell cell = scene.cell(row, column);
    for (int n = 0; n < 100; ++n) {
        const cell::CellResult found =
            regime::find_steady_state(cell.oscillator, start_of(scene.job().starts, cell, n), {});
        if (found.regime == Regime::periodic && found.impacts == 1 && found.period == 2) {
            return KnownMotions::motion_of(found);
        }
    }
    ADD_FAILURE() << "no 1/2";
    return {};
}

Pairs told(const std::vector<KnownMotions::NewResult>& results) {
    Pairs pairs;
    for (const auto& [cell, result] : results) pairs.emplace_back(cell, result.regime);
    return pairs;
}

Pairs periodic(const std::vector<std::int64_t>& cells) {
    Pairs pairs;
    for (const std::int64_t cell : cells) pairs.emplace_back(cell, Regime::periodic);
    return pairs;
}

struct Known {
    scene::Scene scene;
    int looks = 0;
    KnownMotions motions;

    Known(const job::Job& job, std::int64_t first, std::int64_t end,
          const std::vector<std::int64_t>& without = {})
        : scene(job), motions(scene, first, end, [this] { ++looks; }) {
        for (std::int64_t cell = first * scene.columns(); cell < end * scene.columns(); ++cell) {
            if (std::ranges::count(without, cell) == 0) motions.add(cell, {});
        }
    }
};

TEST(KnownMotions, AreContinuedToTheFourCellsBeside) {
    Known known(grid(3, 3), 0, 3);
    const KnownMotion middle = one_impact(known.scene, 1, 1);
    const std::vector<KnownMotions::CellMotion> news{{4, middle}};
    const auto found = known.motions.spread(news);
    EXPECT_EQ(told(found), periodic({1, 3, 5, 7}));
    for (const auto& [cell, result] : found) {
        EXPECT_EQ(result.impacts, 1);
        EXPECT_EQ(result.period, 2);
        EXPECT_NEAR(result.orbit_displacement, middle.displacement, 0.3);
    }
    EXPECT_GT(known.looks, 0);
    EXPECT_TRUE(known.motions.spread(news).empty());  // they know it now
}

// Nor is the first cell of a row beside the last one of the row before.
TEST(KnownMotions, StayInTheirRowsAndInCellsThatAreThere) {
    Known known(grid(3, 4), 1, 4, {7});
    const KnownMotion motion = one_impact(known.scene, 1, 2);
    EXPECT_EQ(told(known.motions.spread(std::vector<KnownMotions::CellMotion>{{5, motion}})), periodic({4, 8}));
    EXPECT_EQ(told(known.motions.spread(std::vector<KnownMotions::CellMotion>{{9, motion}})),
              periodic({6, 10}));
    EXPECT_EQ(told(known.motions.spread(std::vector<KnownMotions::CellMotion>{{2, motion}})), periodic({5}));
}

TEST(KnownMotions, OfSeveralCellsComeInTheOrderOfCellsAndOnce) {
    Known known(grid(3, 1), 0, 1);
    const KnownMotion motion = one_impact(known.scene, 0, 1);
    const auto found =
        known.motions.spread(std::vector<KnownMotions::CellMotion>{{0, motion}, {1, motion}, {2, motion}});
    EXPECT_EQ(told(found), periodic({0, 1, 2}));
}

TEST(KnownMotions, WithoutAnOrbitAreNotContinued) {
    Known known(grid(3, 1), 0, 1);
    const KnownMotion chaos{.regime = Regime::chaotic};
    EXPECT_TRUE(
        known.motions.spread(std::vector<KnownMotions::CellMotion>{{1, chaos}, {1, without_impact}}).empty());
}

TEST(KnownMotions, WithoutImpactAreThoseThatACellLacks) {
    Known known(grid(3, 2), 1, 2, {5});
    known.motions.add(3, {without_impact});
    EXPECT_EQ(told(known.motions.free_motions()), (Pairs{{4, Regime::no_impact}}));
    EXPECT_TRUE(known.motions.free_motions().empty());
    job::Job near = grid(3, 1);
    near.rows = {0.1, 0.2, 1};
    Known pressed(near, 0, 1);
    EXPECT_TRUE(pressed.motions.free_motions().empty());
}

}  // namespace
}  // namespace peterka::attractors
