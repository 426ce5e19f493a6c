#include <gtest/gtest.h>

#include <cmath>
#include <span>
#include <vector>

#include "map_file/audit_table.hpp"

namespace peterka::map_file {
namespace {

AuditRow row(double force_error, bool agrees) {
    return {
        .again = {}, .force_error = force_error, .agrees = agrees, .starts = {}, .rigs = {}, .seconds = 0.5};
}

TEST(AuditReport, QuantilesAreThoseThatEnoughCellsDoNotExceed) {
    std::vector<AuditRow> rows;
    for (int i = 200; i > 0; --i) rows.push_back(row(i, true));
    rows.push_back(row(regime::unknown, false));
    const AuditReport result = report(rows);
    EXPECT_EQ(result.cells, 201);
    EXPECT_EQ(result.agreeing, 200);
    EXPECT_EQ(result.compared, 200);
    EXPECT_EQ(result.median_force_error, 100);
    EXPECT_EQ(result.force_error_99_percent, 198);
    EXPECT_EQ(result.largest_force_error, 200);
    EXPECT_NEAR(result.seconds_per_cell, 0.5, 1e-12);
}

TEST(AuditReport, CountsLabelsThatRoundingDecides) {
    const auto other = [](double sensitivity) {
        return AuditRow{.again = {}, .sensitivity = sensitivity, .agrees = false, .starts = {}, .rigs = {}};
    };
    const std::vector<AuditRow> rows{row(1e-5, true), other(55), other(415), other(19), other(regime::unknown)};
    const AuditReport result = report(rows);
    EXPECT_EQ(result.agreeing, 1);
    EXPECT_EQ(result.decided_by_rounding, 2);
}

TEST(AuditReport, FilledCellsAreCountedApart) {
    AuditRow filled = row(regime::unknown, true);
    filled.computed = false;
    AuditRow wrong = filled;
    wrong.agrees = false;
    wrong.sensitivity = 55;  // of a run that the map hasn't made
    const AuditReport result = report(std::vector<AuditRow>{row(1e-5, true), filled, filled, wrong});
    EXPECT_EQ(result.agreeing, 3);
    EXPECT_EQ(result.filled, 3);
    EXPECT_EQ(result.agreeing_filled, 2);
    EXPECT_EQ(result.decided_by_rounding, 0);
    EXPECT_EQ(result.compared, 1);
    EXPECT_EQ(result.compared_filled, 0);
}

TEST(AuditReport, ForcesOfFilledCellsAreComparedApart) {
    std::vector<AuditRow> rows(3, row(regime::unknown, true));
    for (int i = 0; i < 3; ++i) rows[static_cast<std::size_t>(i)].filled_force_error = 3 - i;
    rows.push_back(row(1e-5, true));
    const AuditReport result = report(rows);
    EXPECT_EQ(result.compared, 1);
    EXPECT_EQ(result.largest_force_error, 1e-5);
    EXPECT_EQ(result.compared_filled, 3);
    EXPECT_EQ(result.median_filled_error, 2);
    EXPECT_EQ(result.largest_filled_error, 3);
}

TEST(AuditReport, WithoutForcesToCompareThereAreNoErrors) {
    const AuditRow only = row(regime::unknown, true);
    const AuditReport result = report(std::span(&only, 1));
    EXPECT_EQ(result.compared, 0);
    EXPECT_TRUE(std::isnan(result.median_force_error));
    EXPECT_TRUE(std::isnan(result.largest_force_error));
}

}  // namespace
}  // namespace peterka::map_file
