// Outcomes of drawn rigs: their probabilities, their order, and the quantiles of their strengths.
#include "attractors/outcomes.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace peterka::attractors {
namespace {

using OfRigs = attractors::Outcomes;
using cell::CellResult;
using cell::Regime;

CellResult end(Regime regime, std::int32_t impacts = 0, std::int32_t period = 0, double force = 1) {
    CellResult result;
    result.regime = regime;
    result.impacts = impacts;
    result.period = period;
    result.peak_force = force;
    result.impact_speed = 2 * force;
    return result;
}

scene::Cell own_cell(double weight_n = 1) {
    scene::Cell cell;
    cell.oscillator.contact = scene::KelvinVoigt<double>{100, 1};
    cell.scales.weight_n = weight_n;
    return cell;
}

TEST(Outcomes, AreToldByLabelTheMostLikelyFirst) {
    OfRigs outcomes(own_cell());
    for (int i = 0; i < 5; ++i) outcomes.add(end(Regime::periodic, 1, 2), {});
    for (int i = 0; i < 3; ++i) outcomes.add(end(Regime::chaotic, 0, 0, i), {});
    outcomes.add(end(Regime::no_impact, 0, 1), {});
    outcomes.add(end(Regime::periodic, 2, 2), {});
    SolvedCell solved;
    outcomes.tell(solved);
    ASSERT_EQ(solved.outcomes.size(), 4U);
    EXPECT_EQ(solved.cell.outcomes, 4);
    EXPECT_EQ(solved.cell.outcome_others, 0);
    EXPECT_EQ(solved.outcomes[0].impacts, 1);
    EXPECT_EQ(solved.outcomes[0].period, 2);
    EXPECT_EQ(solved.outcomes[0].probability, 0.5);
    EXPECT_EQ(solved.outcomes[1].regime, Regime::chaotic);
    EXPECT_EQ(solved.outcomes[1].probability, 0.3);
    EXPECT_EQ(solved.outcomes[2].regime, Regime::no_impact);  // of equal ones, by regime
    EXPECT_EQ(solved.outcomes[3].impacts, 2);
}

TEST(Outcomes, BeyondEightAreTheOthers) {
    OfRigs outcomes(own_cell());
    for (std::int32_t q = 1; q <= 11; ++q) {
        for (std::int32_t i = q; i <= 11; ++i) outcomes.add(end(Regime::periodic, 1, q), {});
    }
    SolvedCell solved;
    outcomes.tell(solved);
    EXPECT_EQ(solved.cell.outcomes, 11);
    EXPECT_EQ(solved.outcomes.size(), 8U);
    EXPECT_DOUBLE_EQ(solved.cell.outcome_others, 6.0 / 66);  // 3 + 2 + 1
}

TEST(Outcomes, QuantilesAreNearestRanksAndNoImpactIsNoForce) {
    OfRigs outcomes(own_cell());
    for (int force = 1; force <= 90; ++force) outcomes.add(end(Regime::periodic, 1, 1, force), {});
    for (int i = 0; i < 10; ++i) outcomes.add(end(Regime::no_impact, 0, 1, 1000), {});
    outcomes.add(end(Regime::failed, 0, 0, std::nan("")), {});  // has no force
    SolvedCell solved;
    outcomes.tell(solved);
    EXPECT_EQ(solved.cell.drawn_q05, 0);
    EXPECT_EQ(solved.cell.drawn_q50, 40);
    EXPECT_EQ(solved.cell.drawn_q95, 85);
    EXPECT_DOUBLE_EQ(solved.outcomes[2].probability, 1.0 / 101);
}

// So that what all but 5 % reach is reached by 95 % of all rigs.
TEST(Outcomes, AFailedRigReachesNoForce) {
    OfRigs outcomes(own_cell());
    for (int force = 1; force <= 90; ++force) outcomes.add(end(Regime::periodic, 1, 1, force), {});
    for (int i = 0; i < 10; ++i) outcomes.add(end(Regime::failed, 0, 0, std::nan("")), {});
    SolvedCell solved;
    outcomes.tell(solved);
    EXPECT_EQ(solved.cell.drawn_q05, 0);
    EXPECT_EQ(solved.cell.drawn_q50, 40);
    EXPECT_EQ(solved.cell.drawn_q95, 85);
}

// Newtons are what counts: those of the drawn rig, over the weight of the cell's own hammer.
TEST(Outcomes, ForcesAreOverTheWeightOfTheOwnHammer) {
    OfRigs outcomes(own_cell(2.0));
    outcomes.add(end(Regime::periodic, 1, 1, 3), {.length_m = 1, .force_n = 10, .weight_n = 7});
    SolvedCell solved;
    outcomes.tell(solved);
    EXPECT_DOUBLE_EQ(solved.cell.drawn_q50, 15);
}

TEST(Outcomes, OnARigidStopTheSpeedTakesTheForcesPlace) {
    scene::Cell own = own_cell();
    own.oscillator.contact = scene::Restitution<double>{0.5};
    OfRigs outcomes(own);
    outcomes.add(end(Regime::periodic, 1, 1, 3), {.length_m = 0.5, .frequency_rad_per_s = 4});
    SolvedCell solved;
    outcomes.tell(solved);
    EXPECT_DOUBLE_EQ(solved.cell.drawn_q95, 12);
}

TEST(Outcomes, WhereAllRigsFailThereIsNoQuantile) {
    OfRigs outcomes(own_cell());
    outcomes.add(end(Regime::failed, 0, 0, std::nan("")), {});
    SolvedCell solved;
    outcomes.tell(solved);
    EXPECT_TRUE(std::isnan(solved.cell.drawn_q50));
}

}  // namespace
}  // namespace peterka::attractors
