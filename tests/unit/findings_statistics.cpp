// The numbers of the summary are independent of the grouping of the cells.
#include "findings/statistics.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "map_examples.hpp"

namespace peterka::findings {
namespace {

using regime::Regime;

// A row of cells as a tile at (5, 10).
Statistics statistics_of(const std::vector<quantities::StoredCell>& cells) {
    Statistics statistics;
    add_tile(statistics, {0, 5, 10, {1, std::ssize(cells)}}, cells);
    return statistics;
}

quantities::StoredCell cell_of(Regime regime, double force, std::int32_t impacts = 0, std::int32_t period = 0) {
    quantities::StoredCell cell;
    cell.regime = regime;
    cell.peak_force = force;
    cell.impacts = impacts;
    cell.period = period;
    cell.cycles = 10;
    return cell;
}

TEST(OutputStatistics, CountsRegimesReasonsCyclesAndClasses) {
    quantities::StoredCell failed = cell_of(Regime::failed, regime::unknown);
    failed.status = regime::Status::not_finite;
    quantities::StoredCell unresolved = cell_of(Regime::unresolved, 2);
    unresolved.status = regime::Status::conservative;
    const quantities::StoredCell not_computed = cell_of(static_cast<Regime>(regime::regime_not_computed), 1e9);
    const Statistics statistics = statistics_of(
        {cell_of(Regime::periodic, 1, 2, 2), failed, cell_of(Regime::periodic, 1, 1, 1), unresolved,
         not_computed, cell_of(Regime::periodic, 1, 2, 2), cell_of(Regime::no_impact, 0, 0, 1)});
    EXPECT_EQ(statistics.counts.cells, 6);
    EXPECT_EQ(statistics.counts.cycles, 60);
    EXPECT_EQ(statistics.cells_of(Regime::periodic), 3);
    EXPECT_EQ(statistics.cells_of(Regime::no_impact), 1);
    EXPECT_EQ(statistics.cells_of(Regime::chaotic), 0);
    EXPECT_EQ(statistics.counts.failed_by_status, (std::array<std::int64_t, 9>{0, 0, 0, 0, 1}));
    EXPECT_EQ(statistics.counts.unresolved_by_status, (std::array<std::int64_t, 9>{0, 0, 1}));
    EXPECT_EQ(statistics.periodic_cells, (std::map<ImpactClass, std::int64_t>{{{1, 1}, 1}, {{2, 2}, 2}}));
}

TEST(OutputStatistics, CountsOfTwoPartsAddUp) {
    quantities::StoredCell filled = cell_of(Regime::periodic, 1, 1, 1);
    filled.computed = false;
    Counts sum = statistics_of({cell_of(Regime::periodic, 1, 1, 1), filled}).counts;
    sum.add(statistics_of({cell_of(Regime::chaotic, 1)}).counts);
    EXPECT_EQ(sum.cells, 3);
    EXPECT_EQ(sum.filled, 1);
    EXPECT_EQ(sum.cycles, 30);
    EXPECT_EQ(sum.by_regime[static_cast<std::size_t>(Regime::periodic)], 2);
    EXPECT_EQ(sum.by_regime[static_cast<std::size_t>(Regime::chaotic)], 1);
}

TEST(OutputStatistics, ChaosIsObservedWhereItWasComputed) {
    const auto followed = [](Regime regime, std::int32_t cycles, bool computed) {
        quantities::StoredCell cell = cell_of(regime, 1);
        cell.observed_cycles = cycles;
        cell.computed = computed;
        return cell;
    };
    const Statistics statistics =
        statistics_of({followed(Regime::chaotic, 300, true), followed(Regime::chaotic, 500, true),
                       followed(Regime::unresolved, 20, true), followed(Regime::chaotic, 9000, false)});
    EXPECT_EQ(statistics.chaos.fewest, 300);
    EXPECT_EQ(statistics.chaos.most, 500);
}

TEST(OutputStatistics, LivesOfImpactsThatEnd) {
    const auto ends_after = [](std::int32_t cycles) {
        quantities::StoredCell cell = cell_of(Regime::no_impact, 0, 0, 1);
        cell.last_impact = cycles;
        return cell;
    };
    quantities::StoredCell filled = cell_of(Regime::periodic, 1, 1, 1);  // no run of its own
    filled.computed = false;
    Statistics statistics = statistics_of({ends_after(0), ends_after(30), ends_after(301), filled,
                                           cell_of(Regime::periodic, 1, 1, 1), cell_of(Regime::chaotic, 1),
                                           cell_of(Regime::unresolved, 1), cell_of(Regime::failed, 1)});
    EXPECT_EQ(statistics.transients.cells, 5);  // neither filled nor undecided
    EXPECT_EQ(statistics.transients.ended, 2);
    EXPECT_EQ(statistics.transients.cycles, 331);
    EXPECT_EQ(statistics.transients.longest, 301);
    EXPECT_EQ(statistics.transients.impacting, (std::array<std::int64_t, 6>{3, 3, 3, 2, 2, 2}));
    Transients twice = statistics.transients;
    twice.add(statistics.transients);
    EXPECT_EQ(twice.cycles, 662);
    EXPECT_EQ(twice.longest, 301);
    EXPECT_EQ(twice.impacting[0], 6);
}

TEST(OutputStatistics, OfChaosThatIsNotToldYetTheOneWithFewestImpacts) {
    const auto so_far = [](double rate) {
        quantities::StoredCell cell = cell_of(Regime::unresolved, 1);
        cell.status = regime::Status::chaotic_so_far;
        cell.impact_rate = rate;
        return cell;
    };
    EXPECT_FALSE(statistics_of({cell_of(Regime::unresolved, 1)}).longest.found());
    const LongestChaos found = statistics_of({so_far(0.5), so_far(0.2), so_far(0.3), so_far(0.2)}).longest;
    EXPECT_EQ(found.impact_rate, 0.2);
    EXPECT_EQ(found.row, 5);
    EXPECT_EQ(found.column, 11);
}

TEST(OutputStatistics, TheLargestForceIsThatInNewtonsWhereMassesDiffer) {
    const std::vector<quantities::StoredCell> cells{cell_of(Regime::periodic, 9, 1, 1),
                                                    cell_of(Regime::periodic, 2, 1, 1)};
    Statistics statistics;
    add_tile(statistics, {0, 5, 10, {1, 2}}, cells, std::vector<double>{0.1, 2.0});
    EXPECT_EQ(statistics.largest.one_to_one.column, 11);
    EXPECT_EQ(statistics.largest.any_regime.peak_force_ratio, 2);
}

TEST(OutputStatistics, LargestForcesAndWhere) {
    const Statistics statistics = statistics_of(
        {cell_of(Regime::failed, regime::unknown), cell_of(Regime::periodic, 7, 1, 2),
         cell_of(Regime::periodic, 5, 1, 1), cell_of(Regime::chaotic, 9), cell_of(Regime::periodic, 4, 1, 1)});
    EXPECT_EQ(statistics.largest.any_regime.peak_force_ratio, 9);
    EXPECT_EQ(statistics.largest.any_regime.row, 5);
    EXPECT_EQ(statistics.largest.any_regime.column, 13);
    EXPECT_EQ(statistics.largest.any_regime.regime, static_cast<std::int64_t>(Regime::chaotic));
    EXPECT_EQ(statistics.largest.one_to_one.regime, static_cast<std::int64_t>(Regime::periodic));
    EXPECT_EQ(statistics.largest.one_to_one.peak_force_ratio, 5);
    EXPECT_EQ(statistics.largest.one_to_one.column, 12);
}

TEST(OutputStatistics, NothingIsFoundAmongNothing) {
    EXPECT_FALSE(statistics_of({cell_of(Regime::failed, regime::unknown)}).largest.any_regime.found());
    EXPECT_FALSE(statistics_of({cell_of(Regime::periodic, 3, 1, 2)}).largest.one_to_one.found());
}

TEST(OutputStatistics, LowestCellWinsADrawInEitherOrder) {
    const LargestForce low{3, 1, 9};
    const LargestForce high{3, 2, 0};
    for (const auto& [first, second] : {std::pair{low, high}, {high, low}}) {
        LargestForce largest;
        largest.take(first);
        largest.take(second);
        largest.take({regime::unknown, 0, 0});
        EXPECT_EQ(largest.row, 1);
        EXPECT_EQ(largest.column, 9);
    }
}

TEST(OutputStatistics, FailureTextNamesEachReason) {
    Counts counts;
    EXPECT_EQ(failure_text(counts), "");
    counts.failed_by_status = {0, 0, 0, 1, 1200};
    counts.unresolved_by_status = {0, 2};
    EXPECT_EQ(failure_text(counts),
              "1 cell failed: too_many_events\n1,200 cells failed: not_finite\n2 cells unresolved: budget\n");
}

}  // namespace
}  // namespace peterka::findings
