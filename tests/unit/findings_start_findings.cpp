// What the attractors of a map's cells say together, counted cell by cell, tile by tile.
#include "findings/start_findings.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace peterka::findings {
namespace {

using quantities::StoredAttractor;
using quantities::StoredCell;
using regime::Regime;

const StoredAttractor striking{.regime = Regime::periodic, .impacts = 1, .period = 1, .share = 0.25};
const StoredAttractor swinging_free{.regime = Regime::no_impact, .impacts = 0, .period = 1, .share = 0.75};
const StoredAttractor known_swing{.regime = Regime::no_impact, .impacts = 0, .period = 1, .share = 0};

// A row of cells, of which each has its attractors.
struct Row {
    std::vector<StoredCell> cells;
    std::vector<std::vector<StoredAttractor>> attractors;

    void add(std::int32_t start_on, const std::vector<StoredAttractor>& here, std::int32_t all = -1) {
        StoredCell& cell = cells.emplace_back();
        cell.attractors = all < 0 ? static_cast<std::int32_t>(here.size()) : all;
        cell.start_attractor = start_on;
        cell.regime = cell::Regime::periodic;
        attractors.push_back(here);
    }
    void add_to(StartFindings& findings, std::size_t slots = 3) const {
        std::vector<StoredAttractor> by_slot;
        for (std::size_t slot = 0; slot < slots; ++slot) {
            for (const auto& here : attractors)
                by_slot.push_back(slot < here.size() ? here[slot] : StoredAttractor{});
        }
        add_attractors(findings, {0, 0, 0, {1, std::ssize(cells)}}, cells, by_slot);
    }
};

TEST(StartFindings, AFilledCellHasNoMotionsThatWereNotFollowed) {
    for (const std::size_t slots : {0, 3}) {
        Row row;
        row.add(0, {striking});
        row.add(0, {striking});
        row.cells[1].computed = false;
        StartFindings findings;
        row.add_to(findings, slots);
        EXPECT_EQ(findings.counts.lives.others, 1);
    }
}

TEST(StartFindings, EachCellCountsOnceForWhatIsTrueOfIt) {
    Row row;
    row.add(0, {swinging_free, striking});     // both kinds
    row.add(1, {swinging_free, striking});     // [start] is on the smaller share
    row.add(-1, {swinging_free, striking});    // so it is on one that isn't kept
    row.add(0, {swinging_free});               // never hits
    row.add(0, {striking, known_swing}, 1);    // a swinging_free that no start reached
    row.add(0, {swinging_free, striking}, 5);  // more than are kept
    StartFindings findings;
    row.add_to(findings);
    const StartCounts& counts = findings.counts;
    EXPECT_EQ(counts.cells, 6);
    EXPECT_EQ(counts.mixed, 5);
    EXPECT_EQ(counts.never_hit, 1);
    EXPECT_EQ(counts.minority, 2);
    EXPECT_EQ(counts.not_kept, 1);
    EXPECT_EQ(counts.known_free, 1);
    EXPECT_EQ(counts.known_hit, 0);
    EXPECT_EQ(counts.left_over, 1);
    EXPECT_EQ(counts.by_number[1], 2);
    EXPECT_EQ(counts.by_number[2], 3);
    EXPECT_EQ(counts.by_number[5], 1);
    const AttractorLabel of_orbit{Regime::periodic, 1, 1};
    const AttractorLabel of_swing{Regime::no_impact, 1, 0};
    const AttractorPair pair{std::min(of_orbit, of_swing), std::max(of_orbit, of_swing)};
    EXPECT_EQ(findings.pairs, (std::map<AttractorPair, std::int64_t>{{pair, 4}}));
}

TEST(StartFindings, UnresolvedMotionsAreNeitherWithImpactsNorWithout) {
    const StoredAttractor unresolved{.regime = Regime::unresolved, .share = 0.25};
    const StoredAttractor known_unresolved{.regime = Regime::unresolved, .share = 0};
    Row row;
    row.add(0, {unresolved});
    row.add(0, {swinging_free, unresolved});
    row.add(0, {striking, unresolved});
    row.add(0, {striking, known_unresolved}, 1);
    row.add(0, {swinging_free, {.regime = Regime::sustained_contact, .share = 0.25}});
    StartFindings findings;
    row.add_to(findings);
    EXPECT_EQ(findings.counts.mixed, 0);
    EXPECT_EQ(findings.counts.never_hit, 1);
    EXPECT_EQ(findings.counts.known_free, 0);
    EXPECT_EQ(findings.counts.by_number[0], 1);
    EXPECT_EQ(findings.counts.by_number[1], 3);
    EXPECT_EQ(findings.counts.by_number[2], 1);
    EXPECT_EQ(findings.pairs.size(), 1U);
}

TEST(StartFindings, FailedStartsAreCountedByTheirShare) {
    Row row;
    row.add(0, {striking, {.regime = Regime::failed, .share = 0.25}});
    row.add(0, {{.regime = Regime::failed, .share = 0.5}, striking});
    row.add(0, {striking});
    StartFindings findings;
    row.add_to(findings);
    EXPECT_EQ(findings.counts.failing, 2);
    EXPECT_EQ(findings.counts.most_failing, 0.5);
    EXPECT_EQ(findings.counts.by_number[1], 3);
    StartCounts sum;
    sum.add(findings.counts);
    sum.add(findings.counts);
    EXPECT_EQ(sum.failing, 4);
    EXPECT_EQ(sum.most_failing, 0.5);
}

TEST(StartFindings, PairsAreOfTheLargestSharesThatAreResolved) {
    const StoredAttractor unresolved{.regime = Regime::unresolved, .share = 0.5};
    Row row;
    row.add(0, {unresolved, striking, swinging_free});
    row.add(0, {striking, unresolved});
    StartFindings findings;
    row.add_to(findings);
    const AttractorLabel of_orbit{Regime::periodic, 1, 1};
    const AttractorLabel of_swing{Regime::no_impact, 1, 0};
    EXPECT_EQ(findings.pairs, (std::map<AttractorPair, std::int64_t>{{{of_swing, of_orbit}, 1}}));
}

TEST(StartFindings, AStartThatIsNotResolvedEndsOnNoAttractor) {
    Row row;
    for (const auto regime : {cell::Regime::unresolved, cell::Regime::failed, cell::Regime::chaotic}) {
        row.add(-1, {swinging_free, striking});
        row.cells.back().regime = regime;
        row.add(1, {swinging_free, striking});
        row.cells.back().regime = regime;
    }
    StartFindings findings;
    row.add_to(findings);
    EXPECT_EQ(findings.counts.minority, 2);
    EXPECT_EQ(findings.counts.not_kept, 1);
}

TEST(StartFindings, AreSumsOverTheTiles) {
    Row row;
    row.add(-1, {swinging_free, striking}, 5);
    row.add(1, {striking, known_swing, striking}, 3);
    StartFindings once;
    row.add_to(once);
    StartFindings twice = once;
    twice.counts.add(once.counts);
    EXPECT_EQ(twice.counts.cells, 4);
    EXPECT_EQ(twice.counts.mixed, 2 * once.counts.mixed);
    EXPECT_EQ(twice.counts.minority, 4);
    EXPECT_EQ(twice.counts.not_kept, 2);
    EXPECT_EQ(twice.counts.left_over, 2 * once.counts.left_over);
    EXPECT_EQ(twice.counts.by_number[5], 2);
    EXPECT_EQ(twice.counts.by_number[3], 2);
}

}  // namespace
}  // namespace peterka::findings
