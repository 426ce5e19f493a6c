// The datasets of branches made up by hand.
#include "curves/branch_tables.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>

#include "curves/mpi_packing.hpp"
#include "rig.hpp"

namespace peterka::curves {
namespace {

BranchPoint point_with(double along, std::size_t cycles, std::size_t impacts) {
    BranchPoint point;
    point.along = point.frequency = along;
    point.gap = 0.5;
    point.force_ratio = 3;
    point.peak_force = 2;
    for (std::size_t i = 0; i < cycles; ++i) point.at_phase_0.push_back({-1 - static_cast<double>(i), 7});
    for (std::size_t i = 0; i < impacts; ++i) point.impact_times.push_back(static_cast<double>(i));
    return point;
}

// Of two branches, of 2 and of 1 points; 3 samples at most.
std::map<std::string, Numbers> values_by_name() {
    job::Job job = testing::job_170mm(0);
    job.kind = job::Kind::curves;
    job.columns = {.from = 0.5, .to = 4.5, .points = 3};
    job.rows = {.from = 0, .to = 5, .points = 3};
    UnstableBranch first;
    first.gap = 0.5;
    first.impacts = 1;
    first.period = 2;
    first.points = {point_with(1.5, 2, 1), point_with(1.75, 2, 1)};
    UnstableBranch second = first;
    second.impacts = 3;
    second.points = {point_with(2.5, 2, 3)};
    std::map<std::string, Numbers> values;
    for (const map_file::Table& table : branch_tables(Rig(job), AxesOfFile(job), {first, second})) {
        values[table.plan.variable.name] = table.values;
    }
    return values;
}

TEST(BranchTables, NumberBranchesPointsAndSamples) {
    const auto values = values_by_name();
    EXPECT_EQ(values.at("branch"), (Numbers{0, 1}));
    EXPECT_EQ(values.at("branch_point"), (Numbers{0, 1, 2}));
    EXPECT_EQ(values.at("branch_sample"), (Numbers{0, 1, 2}));
    EXPECT_EQ(values.at("branch_first"), (Numbers{0, 2}));
    EXPECT_EQ(values.at("branch_points"), (Numbers{2, 1}));
    EXPECT_EQ(values.at("branch_impacts"), (Numbers{1, 3}));
}

TEST(BranchTables, HoldWhatEachPointIs) {
    const auto values = values_by_name();
    EXPECT_EQ(values.at("branch_frequency_ratio"), (Numbers{1.5, 1.75, 2.5}));
    EXPECT_EQ(values.at("branch_peak_force_ratio"), (Numbers{6, 6, 6}));
    const Numbers& places = values.at("branch_stroboscopic_displacement");
    ASSERT_EQ(places.size(), 9U);  // rows of 3, of which these orbits of 2 cycles need 2
    for (const std::size_t row : {0U, 3U, 6U}) {
        EXPECT_EQ(places[row], -0.5);
        EXPECT_EQ(places[row + 1], -1.5);
        EXPECT_TRUE(std::isnan(places[row + 2]));
    }
    const Numbers& impacts = values.at("branch_impact_displacement");
    ASSERT_EQ(impacts.size(), 9U);
    EXPECT_EQ(impacts[0], 0.5);
    EXPECT_TRUE(std::isnan(impacts[1]));
    EXPECT_EQ(impacts[8], std::sin(2.5 * 2) + 0.5);
}

TEST(BranchTables, AreNoneWithoutBranches) {
    const job::Job job = testing::job_170mm(0);
    EXPECT_TRUE(branch_tables(Rig(job), AxesOfFile(job), {}).empty());
}

}  // namespace
}  // namespace peterka::curves
