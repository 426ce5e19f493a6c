#include "findings/life_findings.hpp"

#include <gtest/gtest.h>

#include "report/summary_parts.hpp"
#include "rig.hpp"

namespace peterka::findings {
namespace {

cell::StoredAttractor motion(cell::Regime regime, double life, double error, double least) {
    cell::StoredAttractor attractor;
    attractor.regime = regime;
    attractor.mean_life = life;
    attractor.mean_life_error = error;
    attractor.mean_life_least = least;
    return attractor;
}

LifeFindings of_some() {
    LifeFindings lives;
    lives.add(motion(cell::Regime::periodic, 5, 0.5, cell::unknown), 0, 1);
    lives.add(motion(cell::Regime::no_impact, 3, 0.25, cell::unknown), 1, 0);
    lives.add(motion(cell::Regime::periodic, cell::unknown, cell::unknown, 100), 0, 0);
    lives.add(motion(cell::Regime::periodic, cell::unknown, cell::unknown, 70), 1, 1);
    lives.add(motion(cell::Regime::periodic, cell::unknown, cell::unknown, cell::unknown), 1, 1);
    lives.add(motion(cell::Regime::chaotic, 1, 0.1, cell::unknown), 1, 1);  // that dies without disturbances
    return lives;
}

TEST(LifeFindings, CountSettledMotionsInAnyGrouping) {
    const LifeFindings lives = of_some();
    EXPECT_EQ(lives.motions, 4);
    EXPECT_EQ(lives.others, 1);
    EXPECT_EQ(lives.ending, 2);
    EXPECT_EQ(lives.least_bound, 70);
    EXPECT_EQ(lives.shortest, 3);
    EXPECT_EQ(lives.error, 0.25);
    EXPECT_EQ(lives.row, 1);
    EXPECT_EQ(lives.column, 0);
    LifeFindings grouped;
    grouped.add(LifeFindings{});
    grouped.add(lives);
    grouped.add(LifeFindings{});
    EXPECT_EQ(grouped.motions, 4);
    EXPECT_EQ(grouped.others, 1);
    EXPECT_EQ(grouped.shortest, 3);
    LifeFindings equal = lives;  // of equal lives the first cell's is told
    equal.add(motion(cell::Regime::no_impact, 3, 0.5, cell::unknown), 0, 0);
    EXPECT_EQ(equal.row, 0);
    EXPECT_EQ(equal.error, 0.5);
}

job::Job disturbed(std::int64_t starts) {
    job::Job job = peterka::testing::job_170mm(0);
    job.columns = {1, 2, 2};
    job.rows = {0, 1, 2};
    job.noise.amplitude_relative = 0.01;
    job.starts.count = starts;
    return job;
}

TEST(LivesSummary, TellsTheShortestLifeAndTheLeastBound) {
    const std::string text = lives_summary(scene::Scene(disturbed(8)), of_some());
    EXPECT_NE(text.find("4 attractors followed"), text.npos) << text;
    EXPECT_NE(text.find("50.0 % of these: seen to end; the shortest mean life is 3 +- 0.2 s, at Omega/omega 1"),
              text.npos)
        << text;
    EXPECT_NE(text.find("fewer than 4 lives seen to end; each lasts 70 s or longer, roughly"), text.npos)
        << text;
    EXPECT_NE(text.find("1 settled motion was not followed: the engine could not, the noise is far too strong, "
                        "or it takes more than 5000 forcing cycles to relax"),
              text.npos)
        << text;
    const std::string of_cells = lives_summary(scene::Scene(disturbed(0)), of_some());
    EXPECT_NE(of_cells.find("4 motions followed"), text.npos) << of_cells;
}

TEST(LivesSummary, IsEmptyWithoutNoiseAndSaysWhereNothingSettled) {
    job::Job job = disturbed(0);
    EXPECT_NE(lives_summary(scene::Scene(job), {}).find("there is no settled motion"), std::string::npos);
    const std::string none = lives_summary(scene::Scene(job), {.others = 2});
    EXPECT_NE(none.find("2 settled motions were not followed"), none.npos) << none;
    EXPECT_EQ(none.find("there is no settled motion"), none.npos) << none;
    job.noise = {};
    EXPECT_EQ(lives_summary(scene::Scene(job), of_some()), "");
}

}  // namespace
}  // namespace peterka::findings
