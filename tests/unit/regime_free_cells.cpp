// Cells classified from another cell of the same frequency
// agree with their own search, and no search is begun for them.
#include "regime/free_cells.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <initializer_list>
#include <random>
#include <vector>

#include "attractors/multi_start_pool.hpp"
#include "regime/solve_cell.hpp"
#include "rig.hpp"
#include "same_bytes.hpp"
#include "scene/scene.hpp"
#include "trajectory/lasting_contact.hpp"

namespace peterka::regime {
namespace {

// Rigs, starts and planes of all kinds; gaps along rows or columns, near ones first or last.
job::Job any_plane(std::mt19937& random) {
    const auto one_of = [&](std::initializer_list<double> values) {
        return values.begin()[std::uniform_int_distribution<std::size_t>(0, values.size() - 1)(random)];
    };
    job::Job job = testing::job_170mm(one_of({0, 238.2325, 3e4, 1e6}));
    job.hammer.damping_ns_per_m = one_of({0, 0.06, 1, 30});
    if (one_of({0, 1}) == 1) job.contact = job::Restitution{0.7};
    if (one_of({0, 1}) == 1) job.output.fields = {job::OptionalField::force_per_cycle};
    job.start.displacement_ratio = one_of({0, 0, 0.3, -1.7});
    job.start.velocity_ratio = one_of({0, 0.6});
    job.columns = {1.2, 4.5, 9};
    job.rows = {0.1, one_of({5, 40, 2e4}), 9};
    if (one_of({0, 1}) == 1) std::swap(job.rows.from, job.rows.to);
    return job;
}

job::Job plane(const job::Axis& columns, const job::Axis& rows) {
    job::Job job = testing::job_170mm(238.2325);
    job.columns = columns;
    job.rows = rows;
    return job;
}

TEST(FreeCells, AreWhatEachSaysOfItself) {
    std::mt19937 random(22);
    int told = 0;
    for (int n = 0; n < 200; ++n) {
        const job::Job job = any_plane(random);
        const scene::Scene scene(job);
        FreeCells free_cells(scene);
        for (std::int64_t i = 0; i < scene.rows() * scene.columns(); ++i) {
            const scene::Cell cell = scene.cell(i / scene.columns(), i % scene.columns());
            const auto alone = solve_at_once(job, cell);
            const auto by_another = free_cells.told_by_another(cell);
            const auto found = by_another ? by_another : free_cells.find(cell);
            ASSERT_EQ(found.has_value(), alone.has_value()) << n << " " << i;
            told += by_another ? 1 : 0;
            if (!alone) continue;
            EXPECT_TRUE(testing::same_bytes(*found, *alone)) << n << " " << i;
        }
    }
    EXPECT_GT(told, 1000);
}

TEST(FreeCells, MostAreToldFromAnother) {
    const scene::Scene scene(plane({2.5, 4.5, 16}, {3, 5, 16}));
    FreeCells free_cells(scene);
    int told = 0;
    for (std::int64_t i = 0; i < 256; ++i) {
        const scene::Cell cell = scene.cell(i / 16, i % 16);
        const bool is_told = free_cells.told_by_another(cell).has_value();
        told += is_told ? 1 : 0;
        EXPECT_TRUE(is_told || free_cells.find(cell));
    }
    EXPECT_GE(told, 224);  // two cells of a column may share a place with another column
    EXPECT_LE(free_cells.computed(), 64);
}

TEST(FreeCells, NoneIsSoughtWhereTheMotionWithoutAStopReachesIt) {
    const scene::Scene scene(plane({1.3, 2.0, 8}, {0, 1, 8}));
    FreeCells free_cells(scene);
    for (std::int64_t i = 0; i < 64; ++i) EXPECT_FALSE(free_cells.find(scene.cell(i / 8, i % 8)));
    EXPECT_EQ(free_cells.computed(), 0);
}

// Hence none is searched for (regime/lasting_motion_proof.cpp).
TEST(Contacts, NoneLastsWhereTheHammerRestsBeforeTheStop) {
    std::mt19937 random(22);
    const auto between = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    int lasting = 0;
    for (int n = 0; n < 2000; ++n) {
        scene::Oscillator<double> oscillator = testing::paper_rig(testing::beam_170mm, between(0.01, 6), 0);
        if (n % 2 == 0) oscillator.contact = scene::KelvinVoigt<double>{between(0.1, 1e5), between(0, 300)};
        const auto may_last = [&](double gap) {
            oscillator.gap = gap;
            scene::Oscillator<double> rigid = oscillator;
            rigid.contact = scene::Restitution<double>{0.5};
            return trajectory::LinearContact<double>(oscillator).may_last() ||
                   trajectory::RigidContact<double>(rigid).may_last();
        };
        EXPECT_FALSE(may_last(n % 5 == 0 ? 0 : between(0, 5)));
        lasting += may_last(-between(0, 60)) ? 1 : 0;
    }
    EXPECT_GT(lasting, 500);
}

// A separate search for each cell would cost a map without [starts] twice as much where nothing impacts.
TEST(FreeCells, NoSearchIsBegunForThem) {
    const job::Job job = plane({2.5, 4.5, 6}, {0.5, 5, 6});
    const scene::Scene scene(job);
    const AttractorTable nothing_known;
    std::int64_t solved = 0;
    attractors::MultiStartPool pool(scene, nothing_known, [&](const auto& /*cell*/) { ++solved; });
    std::int64_t at_once = 0;
    for (std::int64_t i = 0; i < 36; ++i) {
        at_once += solve_at_once(job, scene.cell(i / 6, i % 6)) ? 1 : 0;
        pool.add(i / 6, i % 6, i);
    }
    EXPECT_GT(at_once, 12);
    EXPECT_LT(at_once, 36);
    EXPECT_EQ(pool.searches(), 36 - at_once);
    while (!pool.empty()) pool.step();
    EXPECT_EQ(solved, 36);
}

}  // namespace
}  // namespace peterka::regime
