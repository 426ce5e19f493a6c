// What the outcomes of the rigs drawn for a map's cells say together.
#include "findings/outcome_findings.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace peterka::findings {
namespace {

using quantities::StoredCell;
using quantities::StoredOutcome;
using regime::Regime;

StoredCell on_orbit(std::int32_t impacts, std::int32_t period, double others = 0) {
    StoredCell cell;
    cell.regime = Regime::periodic;
    cell.impacts = impacts;
    cell.period = period;
    cell.outcome_others = others;
    return cell;
}

TEST(OutcomeFindings, LikelyOpenAndUnlikeTheJobsOwnRig) {
    const StoredOutcome surely{Regime::periodic, 1, 1, 0.95};
    const StoredOutcome hardly{Regime::periodic, 1, 1, 0.9499};
    StoredCell not_computed;
    not_computed.regime = static_cast<Regime>(regime::regime_not_computed);
    const std::vector<StoredCell> cells{on_orbit(1, 1), on_orbit(1, 1, 0.05), on_orbit(1, 2), on_orbit(2, 1),
                                        not_computed};
    const std::vector<StoredOutcome> outcomes{surely, hardly, surely, hardly, surely};
    OutcomeFindings findings;
    add_outcomes(findings, cells, outcomes);
    EXPECT_EQ(findings.counts.cells, 4);
    EXPECT_EQ(findings.counts.open, 2);
    EXPECT_EQ(findings.counts.other_own, 2);
    EXPECT_EQ(findings.counts.left_over, 1);
    EXPECT_EQ(findings.by_likely, (std::map<AttractorLabel, std::int64_t>{{{Regime::periodic, 1, 1}, 2}}));

    OutcomeCounts sum = findings.counts;
    sum.add(findings.counts);
    EXPECT_EQ(sum.cells, 8);
    EXPECT_EQ(sum.open, 4);
    EXPECT_EQ(sum.other_own, 4);
    EXPECT_EQ(sum.left_over, 2);
}

}  // namespace
}  // namespace peterka::findings
