// Which starts share an attractor, and the order of the slots.
#include "attractors/tally.hpp"

#include <gtest/gtest.h>

#include <utility>
#include <vector>

namespace peterka::attractors {
namespace {

using regime::CellResult;
using regime::Regime;

CellResult orbit(std::int32_t impacts, std::int32_t period, double displacement, double force = 1) {
    CellResult result;
    result.regime = Regime::periodic;
    result.impacts = impacts;
    result.period = period;
    result.peak_force = force;
    result.orbit_displacement = displacement;
    result.orbit_velocity = -1;
    return result;
}

CellResult of_regime(Regime regime, double force = 0) {
    CellResult result;
    result.regime = regime;
    result.peak_force = force;
    return result;
}

TEST(Tally, CountsEachAttractorOnceAndAllChaosAsOne) {
    Tally tally;
    for (const CellResult& result :
         {orbit(1, 2, 0.5), of_regime(Regime::chaotic, 3), orbit(1, 2, 0.5 + 1e-8), orbit(1, 2, 0.7),
          of_regime(Regime::chaotic, 4), of_regime(Regime::chaotic, 2), of_regime(Regime::no_impact)}) {
        tally.add(result, {});
    }
    const auto entries = tally.in_order();
    ASSERT_EQ(entries.size(), 4U);
    EXPECT_EQ(entries[0].result.regime, Regime::chaotic);
    EXPECT_EQ(entries[0].starts, 3);
    EXPECT_EQ(entries[0].result.peak_force, 3);  // of the first start
    EXPECT_EQ(entries[1].starts, 2);
    EXPECT_EQ(as_attractor(entries[1], 7).share, 2.0 / 7);
}

// A start sensitive to rounding is no evidence against an orbit that another start reached reliably.
TEST(Tally, HasTheStatusOfTheStartThatLeavesLeastOpen) {
    using enum regime::Status;
    const auto status_after = [](std::initializer_list<regime::Status> statuses) {
        Tally tally;
        for (const regime::Status status : statuses) {
            CellResult result = orbit(1, 2, 0.5);
            result.status = status;
            tally.add(result, {});
        }
        return as_attractor(tally.in_order().front(), 1).status;
    };
    EXPECT_EQ(status_after({rounding}), rounding);
    EXPECT_EQ(status_after({rounding, verified}), verified);
    EXPECT_EQ(status_after({verified, rounding}), verified);
    EXPECT_EQ(status_after({rounding, imprecise}), imprecise);
    EXPECT_EQ(status_after({imprecise, rounding, verified}), verified);
}

TEST(Tally, OrdersEqualSharesByRegimePeriodImpactsAndForce) {
    Tally tally;
    const CellResult failed = of_regime(Regime::failed, regime::unknown);
    for (const CellResult& result : {failed, orbit(2, 2, 0.1), orbit(1, 2, 0.2, 9), orbit(1, 2, 0.3, 8),
                                     orbit(5, 1, 0.4), of_regime(Regime::no_impact)}) {
        tally.add(result, {});
    }
    const auto entries = tally.in_order();
    ASSERT_EQ(entries.size(), 6U);
    EXPECT_EQ(entries[0].result.regime, Regime::no_impact);
    EXPECT_EQ(entries[1].result.impacts, 5);
    EXPECT_EQ(entries[2].result.peak_force, 8);
    EXPECT_EQ(entries[3].result.peak_force, 9);
    EXPECT_EQ(entries[4].result.impacts, 2);
    EXPECT_EQ(entries[5].result.regime, Regime::failed);
    EXPECT_EQ(slot_of(entries, orbit(1, 2, 0.2, 9)), 3);
    EXPECT_EQ(slot_of(entries, orbit(1, 3, 0.2, 9)), -1);
}

// The weak cubic spring may be omitted for one start and kept for the next: the attractor is still the same.
TEST(Tally, AnOrbitIsTheSameWithAndWithoutAWeakTerm) {
    Tally tally;
    CellResult with = orbit(1, 1, 0.5 + 1e-4);
    with.engine = regime::Engine::split;
    tally.add(orbit(1, 1, 0.5), {});
    tally.add(with, {});
    EXPECT_EQ(tally.in_order().size(), 1U);
    tally.add(orbit(1, 1, 0.5 + 1e-4), {});
    EXPECT_EQ(tally.in_order().size(), 2U);
}

// The end state of [start] is one of a cell's attractors, whether another start found it or not.
TEST(Tally, KeepsTheOwnMotionAndTheLargestShares) {
    const auto kept_with = [](const CellResult& own, std::size_t most) {
        Tally tally;
        for (const double displacement : {0.1, 0.1, 0.1, 0.2, 0.2, 0.3})
            tally.add(orbit(1, 1, displacement), {});
        auto entries = tally.in_order();
        keep_most(entries, Tally::entry_of(own, {}), most);
        std::vector<std::pair<double, std::int64_t>> kept;
        for (const auto& entry : entries) kept.emplace_back(entry.result.orbit_displacement, entry.starts);
        return kept;
    };
    using Kept = std::vector<std::pair<double, std::int64_t>>;
    EXPECT_EQ(kept_with(orbit(1, 1, 0.2), 8), (Kept{{0.1, 3}, {0.2, 2}, {0.3, 1}}));
    EXPECT_EQ(kept_with(orbit(1, 1, 0.4), 8), (Kept{{0.1, 3}, {0.2, 2}, {0.3, 1}, {0.4, 0}}));
    EXPECT_EQ(kept_with(orbit(1, 1, 0.4), 3), (Kept{{0.1, 3}, {0.2, 2}, {0.4, 0}}));
    EXPECT_EQ(kept_with(orbit(1, 1, 0.3), 2), (Kept{{0.1, 3}, {0.3, 1}}));
    EXPECT_EQ(kept_with(orbit(1, 1, 0.4), 1), (Kept{{0.1, 3}}));
    EXPECT_EQ(kept_with(of_regime(Regime::unresolved), 2), (Kept{{0.1, 3}, {0.2, 2}}));
}

}  // namespace
}  // namespace peterka::attractors
