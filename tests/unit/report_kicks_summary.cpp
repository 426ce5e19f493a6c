// The critical kicks of many cells, summarised in words.
#include "report/summary_parts.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "findings/kick_counts.hpp"
#include "rig.hpp"

namespace peterka {
namespace {

using findings::KickCounts;
using quantities::StoredAttractor;
using quantities::StoredCell;

StoredAttractor attractor(const cell::Kick& kick, cell::Status status = cell::Status::verified) {
    StoredAttractor attractor;
    attractor.status = status;
    attractor.kick = kick;
    return attractor;
}

// Gaps 0 and 1, frequencies 1 to 5.
scene::Scene with_kicks(std::int64_t starts) {
    job::Job job = peterka::testing::job_170mm(0);
    job.columns = {1, 5, 5};
    job.rows = {0, 1, 2};
    job.starts.count = starts;
    job.output.fields = {cell::OptionalField::critical_kick};
    return scene::Scene(job);
}

const cell::Kick thrown{0.33, 0.25, 0.33, -1, 0.021};
const cell::Kick harder{0.5, 1.75, 0.5, 1, 0.012};
const cell::Kick none{.tried = 4.5};
const cell::Kick not_tried;

KickCounts counts_of_some() {
    KickCounts counts;
    std::int64_t column = 0;
    for (const std::vector<StoredAttractor>& here : std::vector<std::vector<StoredAttractor>>{
             {attractor(not_tried), attractor(harder)},  // chaos has the largest share
             {attractor(thrown)},
             {attractor(none), attractor(thrown)},  // the attractor of largest share counts
             {attractor(none)},
             {attractor(not_tried)}}) {
        add_kick(counts, here, {1, column++});
    }
    return counts;
}

TEST(KickCounts, AreOfTheOrbitWithTheLargestShareInAnyGrouping) {
    const KickCounts counts = counts_of_some();
    EXPECT_EQ(counts.kicked, 4);
    EXPECT_EQ(counts.thrown, 2);
    EXPECT_EQ(counts.alone, 1);
    EXPECT_EQ(counts.smallest, 0.33);
    EXPECT_EQ(counts.phase, 0.25);
    EXPECT_EQ(counts.least_tried, 4.5);
    EXPECT_EQ(counts.most_tried, 4.5);
    KickCounts grouped;
    grouped.add({});
    grouped.add(counts);
    grouped.add({});
    EXPECT_EQ(grouped.smallest, 0.33);
    EXPECT_EQ(grouped.phase, 0.25);
    EXPECT_EQ(grouped.least_tried, 4.5);
    EXPECT_EQ(grouped.most_tried, 4.5);
    EXPECT_EQ(grouped.bounded, 2);
    EXPECT_EQ(grouped.least_bound, 0.012);
    EXPECT_EQ(grouped.row, 1);
    EXPECT_EQ(grouped.column, 1);
}

// Of equal ones, the first cell's; in any order.
TEST(KickCounts, TellWhereTheSmallestIs) {
    const std::vector<StoredAttractor> verified{attractor(thrown)};
    const std::vector<StoredAttractor> rounded{attractor(thrown, cell::Status::rounding)};
    for (const bool forwards : {true, false}) {
        KickCounts counts;
        add_kick(counts, std::vector{attractor(harder)}, {0, 0});
        add_kick(counts, forwards ? rounded : verified, {forwards ? 0 : 1, 2});
        add_kick(counts, forwards ? verified : rounded, {forwards ? 1 : 0, 2});
        EXPECT_EQ(counts.row, 0);
        EXPECT_EQ(counts.column, 2);
        EXPECT_EQ(counts.by_rounding, 1);
        const std::string text = kicks_summary(with_kicks(16), counts);
        EXPECT_NE(text.find("330 mm/s at phase 0.250 cycles, at Omega/omega 3 ("), text.npos) << text;
        EXPECT_NE(text.find(", gap/A0 0 (0 mm), where rounding may decide the label\n"), text.npos) << text;
    }
    KickCounts counts;
    add_kick(counts, verified, {0, 0});
    EXPECT_EQ(kicks_summary(with_kicks(16), counts).find("rounding"), std::string::npos);
}

TEST(KicksSummary, TellsApartWhatThrowsWhatDoesNotAndOneMotionAlone) {
    const std::string text = kicks_summary(with_kicks(16), counts_of_some());
    EXPECT_NE(text.find("in 4 cells, of its orbit with the largest share"), std::string::npos) << text;
    EXPECT_NE(
        text.find("50.0 % of these cells: a kick leads elsewhere, the smallest one found 330 mm/s at phase "
                  "0.250 cycles"),
        std::string::npos)
        << text;
    EXPECT_NE(text.find("25.0 % of these cells: none found up to 4.5 m/s"), std::string::npos) << text;
    EXPECT_NE(text.find("50.0 % of these cells: small kicks are verified to lead back, up to 12 mm/s in each"),
              std::string::npos)
        << text;
    EXPECT_NE(text.find("25.0 % of these cells: one motion alone is known, and none found up to 4.5 m/s"),
              std::string::npos)
        << text;
}

TEST(KicksSummary, TellsFromWhereToWhereCellsWereTried) {
    KickCounts counts = counts_of_some();
    for (const double tried : {0.0126, 101.0, 3.0})
        add_kick(counts, std::vector{attractor({.tried = tried})}, {0, 0});
    const std::string text = kicks_summary(with_kicks(16), counts);
    EXPECT_NE(text.find("14.3 % of these cells: none found up to 12.6 mm/s to 101 m/s, by cell"),
              std::string::npos)
        << text;
    EXPECT_NE(text.find("one motion alone is known, and none found up to 12.6 mm/s to 101 m/s, by cell"),
              std::string::npos)
        << text;
}

// Without [starts] other motions are unknown.
TEST(KicksSummary, OfACellsOwnMotionSaysNothingOfOthers) {
    KickCounts counts;
    StoredCell cell;
    cell.kick = none;
    add_kick(counts, cell, {0, 0});
    add_kick(counts, StoredCell{}, {0, 1});
    const std::string text = kicks_summary(with_kicks(0), counts);
    EXPECT_NE(text.find("in 1 cell\n"), std::string::npos) << text;
    EXPECT_NE(text.find("none found up to 4.5 m/s"), std::string::npos) << text;
    EXPECT_EQ(text.find("alone"), std::string::npos) << text;
    EXPECT_EQ(text.find("verified"), std::string::npos) << text;
    EXPECT_EQ(kicks_summary(scene::Scene(peterka::testing::job_170mm(0)), counts), "");
}

}  // namespace
}  // namespace peterka
