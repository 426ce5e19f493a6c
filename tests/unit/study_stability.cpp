// The stability study: which engines it tries, and what it says of the stiffest stops.
#include "study/stability.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "rig.hpp"
#include "study/battery.hpp"
#include "study/rigid_limit.hpp"

namespace peterka::study {
namespace {

// Springs without a cubic and a stop with a closed form suit all.
TEST(Stability, TriesEachEngineThatFitsAScene) {
    const auto found = std::ranges::find(battery_names(), std::string("gap_at_rest_out_of_reach"));
    ASSERT_NE(found, battery_names().end());
    const auto result = Stability(testing::job_170mm(0)).solve(found - battery_names().begin());
    for (const auto& of_engine : result.of_engines) {
        EXPECT_EQ(of_engine.outcome, Stability::Judgement::agrees);
    }
}

// Speeds that differ from the rigid stop's by 7 kappa^-0.3, whatever the sign.
TEST(Stability, FitsThePowerByWhichSpeedsTendToTheRigidStops) {
    for (const double factor : {7.0, -7.0}) {
        std::vector<Stability::Result> results(battery().size());
        for (std::int64_t rung = 0; rung < rigid_limit_rungs; ++rung) {
            results.push_back(
                {.of_engines = {}, .speed_difference = factor * std::pow(rung_stiffness(rung), -0.3)});
        }
        const Stability study(testing::job_170mm(0));
        EXPECT_NE(study.summary(results).find("stiffness^-0.3000\n"), std::string::npos);
        const auto tables = study.tables(results);
        const auto slope = std::ranges::find(tables, std::string("fitted_slope"),
                                             [](const Table& table) { return table.plan.variable.name; });
        ASSERT_NE(slope, tables.end());
        EXPECT_NEAR(slope->values.at(0), -0.3, 1e-12);
    }
}

}  // namespace
}  // namespace peterka::study
