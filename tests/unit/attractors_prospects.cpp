// When later starts of a cell are classified sooner: from the cycles and outcomes of earlier ones.
#include "attractors/prospects.hpp"

#include <gtest/gtest.h>

namespace peterka::attractors {
namespace {

using regime::CellResult;
using regime::Regime;

constexpr std::int64_t window = 1000;

CellResult chaotic(std::int64_t cycles = window) {
    return {.regime = Regime::chaotic,
            .cycles = static_cast<std::int32_t>(cycles),
            .observed_cycles = static_cast<std::int32_t>(cycles),
            .sensitivity = 300};
}

CellResult settled(std::int32_t cycles, double sensitivity) {
    return {.regime = Regime::no_impact, .cycles = cycles, .sensitivity = sensitivity};
}

Prospects after(int starts, const CellResult& result) {
    Prospects prospects;
    for (int n = 0; n < starts; ++n) prospects.take(result);
    return prospects;
}

// One more start than observed may end differently within the same time: of ten, that is a tenth.
TEST(Prospects, ChaosIsKnownOnceTenStartsWereFollowedForAsLongAsOneIs) {
    EXPECT_FALSE(Prospects().sooner().chaos);
    EXPECT_FALSE(after(9, chaotic()).sooner().chaos);
    EXPECT_TRUE(after(10, chaotic()).sooner().chaos);
    EXPECT_FALSE(after(10, chaotic()).sooner().unresolved);
}

TEST(Prospects, AStartThatEndedOtherwiseAsksForAsManyMore) {
    Prospects prospects = after(19, chaotic());
    prospects.take(settled(500, 60));
    EXPECT_FALSE(prospects.sooner().chaos);
    prospects.take(chaotic());
    EXPECT_TRUE(prospects.sooner().chaos);
}

// However long they were followed, they could have been called chaotic at any time and were not.
TEST(Prospects, StartsThatStayedUnresolvedForLongArentLikeChaos) {
    Prospects prospects;
    for (int n = 0; n < 5; ++n) {
        prospects.take(
            {.regime = Regime::unresolved, .cycles = 3000, .observed_cycles = 3000, .sensitivity = 40});
    }
    prospects.take(chaotic(414));
    EXPECT_FALSE(prospects.sooner().chaos);
}

// Motions that settled at once, or slowly but steadily, never resembled chaos.
TEST(Prospects, StartsThatRememberTheirBeginningTellNothing) {
    Prospects prospects = after(10, chaotic());
    for (int n = 0; n < 20; ++n) {
        prospects.take(settled(40, 60));
        prospects.take(settled(900, 5));
    }
    EXPECT_TRUE(prospects.sooner().chaos);
}

TEST(Prospects, UnresolvedStartsAreGivenUpSoonerOnlyWhereNoneEndsInTheMeantime) {
    const CellResult unresolved{
        .regime = Regime::unresolved, .cycles = 3000, .observed_cycles = 3000, .sensitivity = 3};
    EXPECT_FALSE(after(9, unresolved).sooner().unresolved);
    Prospects prospects = after(10, unresolved);
    EXPECT_TRUE(prospects.sooner().unresolved);
    EXPECT_LT(Prospects::smaller({.max_cycles = 3000}).max_cycles, 3000);
    EXPECT_EQ(Prospects::smaller({.max_cycles = 200}).max_cycles, 200);
    prospects.take(settled(2000, 3));
    EXPECT_FALSE(prospects.sooner().unresolved);
}

// Otherwise chaos with uncertain statistics would be cut short.
TEST(Prospects, WhereThereIsChaosItHasToBeKnownFirst) {
    const CellResult unresolved{
        .regime = Regime::unresolved, .cycles = 3000, .observed_cycles = 3000, .sensitivity = 3};
    Prospects prospects = after(10, unresolved);
    prospects.take(chaotic());
    EXPECT_FALSE(prospects.sooner().unresolved);
    for (int n = 0; n < 9; ++n) prospects.take(chaotic());
    EXPECT_TRUE(prospects.sooner().chaos && prospects.sooner().unresolved);
}

}  // namespace
}  // namespace peterka::attractors
