// A search as a whole, on one rank, against its coarse map.
#include "curves/search.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "rig.hpp"

namespace peterka::curves {
namespace {

constexpr std::int64_t columns = 5;
constexpr std::int64_t rows = 2;

// Of 1/1, 2/2, 3/2, and of longer periods and chaos, which curves up to q = 2 do not cover.
CurveSearchResult small_search() {
    job::Job job = testing::job_170mm(0);
    job.kind = job::Kind::curves;
    job.columns = {.from = 2.5, .to = 3.3, .points = columns};
    job.rows = {.from = 0.1, .to = 0.4, .points = rows};
    job.curves.max_period = 2;
    return find_curves(scene::Scene(job), [](std::int64_t count, const Task& task, const Done& done) {
        std::vector<Numbers> results;
        for (std::int64_t i = 0; i < count; ++i) results.push_back(task(i));
        done(count);
        return results;
    });
}

TEST(CurveSearch, CountsEdgesBetweenMotionsThatCurvesCover) {
    const CurveSearchResult found = small_search();
    ASSERT_EQ(std::ssize(found.sites), columns * rows);
    std::int64_t covered = 0;
    std::int64_t others = 0;
    const auto look = [&](std::int64_t one, std::int64_t other) {
        const Site& a = found.sites[static_cast<std::size_t>(one)];
        const Site& b = found.sites[static_cast<std::size_t>(other)];
        if (same_label(a, b) || (!a.is_periodic(2) && !b.is_periodic(2))) return;
        const auto is_covered = [](const Site& site) {
            return site.is_periodic(2) || site.regime == regime::Regime::no_impact;
        };
        ++(is_covered(a) && is_covered(b) ? covered : others);
    };
    for (std::int64_t cell = 0; cell < columns * rows; ++cell) {
        if (cell % columns + 1 < columns) look(cell, cell + 1);
        if (cell + columns < columns * rows) look(cell, cell + columns);
    }
    EXPECT_GT(covered, 1);
    EXPECT_GT(others, 1);
    EXPECT_EQ(found.edges.edges, covered);
    EXPECT_GE(found.edges.unexplained(), 0);
}

}  // namespace
}  // namespace peterka::curves
