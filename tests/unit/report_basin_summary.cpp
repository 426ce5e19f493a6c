// The attractors of a basin in words.
#include "report/summary_parts.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "rig.hpp"

namespace peterka {
namespace {

using findings::Attractor;

scene::Scene small_basin() {
    job::Job job = testing::job_170mm(0);
    job.kind = job::Kind::basin;
    job.columns.points = job.rows.points = 1;
    return scene::Scene(job);
}

Attractor periodic(int impacts, int period, double force, std::int64_t cells) {
    Attractor attractor;
    attractor.cell.regime = regime::Regime::periodic;
    attractor.cell.impacts = impacts;
    attractor.cell.period = period;
    attractor.cell.peak_force = force;
    attractor.cell.orbit_displacement = -force / 100;
    attractor.cell.orbit_velocity = 2;
    attractor.cells = cells;
    return attractor;
}

TEST(BasinSummary, TellsTwoOrbitsOfTheSameNameApart) {
    Attractor free;
    free.cell.regime = regime::Regime::no_impact;
    free.cells = 40;
    const std::vector<Attractor> found{free, periodic(2, 1, 31.25, 10), periodic(2, 1, 31.5, 50)};
    const std::string text = basin_summary(small_basin(), found);
    const std::size_t first = text.find("2/1                           50");
    const std::size_t second = text.find("no impact                     40");
    const std::size_t third = text.find("2/1                           10");
    ASSERT_NE(third, std::string::npos) << text;
    EXPECT_LT(first, second) << text;
    EXPECT_LT(second, third) << text;
    EXPECT_NE(text.find("peak force 31.5 weights = 92.055 N, at phase 0 u = -280.4 um, u' = 50.33 mm/s"),
              std::string::npos)
        << text;
    EXPECT_NE(text.find("peak force 31.25 weights = 91.3244 N, at phase 0 u = -278.1 um, u' = 50.33 mm/s"),
              std::string::npos)
        << text;
}

// A rigid stop has no peak force.
TEST(BasinSummary, NamesTheOrbitAloneWhereThereIsNoForce) {
    const std::string text = basin_summary(small_basin(), std::vector{periodic(1, 1, -0.0, 7)});
    EXPECT_NE(text.find("   at phase 0 u ="), std::string::npos) << text;
    EXPECT_EQ(text.find("force"), std::string::npos) << text;
}

TEST(BasinSummary, SaysHowManyItLeavesOut) {
    const std::vector<Attractor> many(11, periodic(1, 3, 20, 1));
    EXPECT_NE(basin_summary(small_basin(), many).find("  and 3 more\n"), std::string::npos);
    EXPECT_EQ(basin_summary(small_basin(), {}), "");
}

}  // namespace
}  // namespace peterka
