#include "findings/sweep_attractors.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace peterka {
namespace {

using quantities::StoredAttractor;
using quantities::StoredCell;
using regime::Regime;

StoredCell on_slot(std::int32_t slot, std::int32_t attractors) {
    StoredCell cell;
    cell.attractors = attractors;
    cell.start_attractor = slot;
    return cell;
}

StoredAttractor loop(std::int32_t impacts, std::int32_t period, double share) {
    return {.regime = Regime::periodic, .impacts = impacts, .period = period, .share = share};
}

const StoredAttractor swinging{.regime = Regime::no_impact, .impacts = 0, .period = 1, .share = 0.5};

// Two branches of three points and two slots: at the first point both are on slot 0, at the second on one
// slot each, at the third on slot 1.
TEST(SweepAttractors, AreBesideTheBranchesWhereNoneIsOnThem) {
    const std::vector<StoredCell> cells{on_slot(0, 2), on_slot(0, 2), on_slot(1, 2),
                                        on_slot(0, 2), on_slot(1, 2), on_slot(1, 2)};
    const std::vector<StoredAttractor> first{loop(1, 1, 0.5), loop(1, 1, 0.5), loop(1, 2, 0.75)};
    const std::vector<StoredAttractor> second{loop(1, 2, 0.5), swinging, loop(1, 1, 0.25)};
    std::vector<StoredAttractor> attractors;
    for (const auto& slot : {first, first, second, second}) {
        attractors.insert(attractors.end(), slot.begin(), slot.end());
    }
    const GapAttractors found = find_beside_branches(cells, attractors, 3);
    EXPECT_EQ(found.points, 3);
    EXPECT_EQ(found.several, 3);
    EXPECT_EQ(found.most, 2);
    EXPECT_EQ(found.with_unvisited, 2);
    ASSERT_EQ(found.unvisited.size(), 1U);
    const Unvisited& half = found.unvisited.front();
    EXPECT_EQ(half.motion.z, (findings::ImpactClass{.period = 2, .impacts = 1}));
    EXPECT_EQ(half.points, 2);
    EXPECT_EQ(half.first, 0);
    EXPECT_EQ(half.last, 2);
    EXPECT_EQ(half.largest_share, 0.75);
    EXPECT_FALSE(half.beside_its_like);
}

// A branch on a 1/1, and another 1/1 that no branch follows.
TEST(SweepAttractors, OneWithTheLabelOfABranchIsAnother) {
    StoredCell branch = on_slot(0, 2);
    branch.regime = Regime::periodic;
    branch.impacts = branch.period = 1;
    const std::vector<StoredAttractor> attractors{loop(1, 1, 0.5), loop(1, 1, 0.5)};
    const GapAttractors found = find_beside_branches(std::vector{branch}, attractors, 1);
    ASSERT_EQ(found.unvisited.size(), 1U);
    EXPECT_TRUE(found.unvisited.front().beside_its_like);
}

// Two orbits of one label at a point are one point of that label.
TEST(SweepAttractors, APointCountsOnceForALabel) {
    const std::vector<StoredCell> cells{on_slot(0, 3), on_slot(0, 3)};
    std::vector<StoredAttractor> attractors;
    for (const double share : {0.6, 0.3, 0.1}) {
        for (int column = 0; column < 2; ++column)
            attractors.push_back(share == 0.6 ? swinging : loop(1, 1, share));
    }
    const GapAttractors found = find_beside_branches(cells, attractors, 2);
    ASSERT_EQ(found.unvisited.size(), 1U);
    EXPECT_EQ(found.unvisited.front().points, 2);
    EXPECT_EQ(found.unvisited.front().largest_share, 0.3);
}

// What is known without a start that found it, such as the swing beside 1/2, is one more at its point.
TEST(SweepAttractors, OneThatNoStartFoundCounts) {
    StoredAttractor known = swinging;
    known.share = 0;
    const std::vector<StoredAttractor> attractors{loop(1, 2, 1), loop(1, 2, 1), known, StoredAttractor{}};
    const GapAttractors found = find_beside_branches(std::vector{on_slot(0, 1), on_slot(0, 1)}, attractors, 2);
    EXPECT_EQ(found.several, 1);
    EXPECT_EQ(found.most, 2);
    ASSERT_EQ(found.unvisited.size(), 1U);
    EXPECT_EQ(found.unvisited.front().motion.regime, Regime::no_impact);
    EXPECT_EQ(found.unvisited.front().points, 1);
    EXPECT_EQ(found.unvisited.front().largest_share, 0);
}

// Of five that starts found two have no slot.
TEST(SweepAttractors, OnesThatAreNotKeptCount) {
    const std::vector<StoredAttractor> attractors{loop(1, 1, 0.5), loop(1, 2, 0.3), swinging};
    EXPECT_EQ(find_beside_branches(std::vector{on_slot(0, 5)}, attractors, 1).most, 5);
}

// Nothing is claimed about these; empty slots hold no attractor.
TEST(SweepAttractors, WithoutAProofCountNowhere) {
    const std::vector<StoredCell> cells{on_slot(0, 2)};
    StoredAttractor unresolved = loop(0, 0, 0.1);
    unresolved.regime = Regime::unresolved;
    const std::vector<StoredAttractor> attractors{swinging, unresolved, StoredAttractor{}};
    const GapAttractors found = find_beside_branches(cells, attractors, 1);
    EXPECT_EQ(found.with_unvisited, 0);
    EXPECT_EQ(found.several, 0);
    EXPECT_EQ(found.most, 1);
}

}  // namespace
}  // namespace peterka
