// The effect of the cubic term on an orbit, predicted from
// the orbit without it, against runs from the start with it.
#include "regime/cubic_shift.hpp"

#include <gtest/gtest.h>

#include "regime/scalar_engine.hpp"
#include "regime/solve_cell.hpp"
#include "rig.hpp"

namespace peterka::regime {
namespace {

using testing::beam_170mm;
using testing::paper_cubic;
using testing::paper_rig;
using testing::start_at;

struct Place {
    double frequency_ratio;
    double gap_ratio;
};

CubicShift shift_at(scene::Oscillator<double> oscillator, double cubic) {
    const CellResult without = find_steady_state(oscillator, start_at(oscillator), {});
    EXPECT_EQ(without.regime, Regime::periodic);
    oscillator.cubic = cubic;
    CycleBroker broker;
    return complete(
        shift_by_cubic(broker, oscillator, {Engine::split, 1e-9, without.largest_displacement}, without),
        broker);
}

// Close to period doublings and folds, where the bound 3 k3 u^2/k over 1 - |multiplier| fails.
TEST(CubicShift, IsWhatARunFromTheStartShows) {
    for (const Place place : {Place{0.94110275689223057, 2.6190476190476191},
                              {3.7380952380952381, 1.3157894736842104},
                              {0.95112781954887216, 2.907268170426065}}) {
        auto oscillator = paper_rig(beam_170mm, place.frequency_ratio, place.gap_ratio);
        const CubicShift shift = shift_at(oscillator, paper_cubic);
        ASSERT_TRUE(shift.change) << place.frequency_ratio;

        const CellResult without = find_steady_state(oscillator, start_at(oscillator), {});
        oscillator.cubic = paper_cubic;
        const CellResult independent =
            find_steady_state(oscillator, start_at(oscillator), {}, {Engine::arkode, 1e-10});
        EXPECT_EQ(independent.impacts, without.impacts);
        EXPECT_EQ(independent.period, without.period);
        const double right = std::abs(independent.peak_force / without.peak_force - 1);
        EXPECT_NEAR(*shift.change / right, 1, 0.2);  // two steps of Newton's method, with a margin
        EXPECT_GT(*shift.change, 1e-5);
        EXPECT_LT(shift.cycles, without.cycles);
    }
}

// If the second Newton step is not small, its change is added to
// the estimate: without that these would be 5 and 3 % too low.
TEST(CubicShift, TellsNoLessThanTheChangeWhereNewtonsMethodIsStillOnItsWay) {
    for (const Place place :
         {Place{4.2688283384865562, 0.83212069649735199}, {2.2871204733876627, 0.9553803944149355}}) {
        auto oscillator = paper_rig(beam_170mm, place.frequency_ratio, place.gap_ratio);
        const CubicShift shift = shift_at(oscillator, paper_cubic);
        ASSERT_TRUE(shift.change) << place.frequency_ratio;
        const CellResult without = find_steady_state(oscillator, start_at(oscillator), {});
        oscillator.cubic = paper_cubic;
        const CellResult independent =
            find_steady_state(oscillator, start_at(oscillator), {}, {Engine::arkode, 1e-10});
        ASSERT_TRUE(same_label(independent, without));
        const double right = std::abs(independent.peak_force / without.peak_force - 1);
        EXPECT_GT(*shift.change, right);
        EXPECT_LT(*shift.change, 1.1 * right);
    }
}

// A softening spring moves the fold of 1/1 past the cell, a hardening one moves it away.
TEST(CubicShift, IsNoneWhereTheOrbitIsLost) {
    const auto at_fold = paper_rig(beam_170mm, 1.8463796477495107, 1.5362035225048922);
    EXPECT_TRUE(shift_at(at_fold, 3 * paper_cubic).change);
    EXPECT_FALSE(shift_at(at_fold, -30 * paper_cubic).change);
}

// Forces there are unbounded: the orbit's own shift is reported.
TEST(CubicShift, IsThatOfTheOrbitOnARigidStop) {
    auto oscillator = paper_rig(beam_170mm, 2.0, 0.5);
    oscillator.contact = scene::Restitution<double>{0.6};
    const CubicShift shift = shift_at(oscillator, paper_cubic);
    ASSERT_TRUE(shift.change);
    EXPECT_GT(*shift.change, 1e-7);
    EXPECT_LT(*shift.change, 1e-3);
}

// Slow impacts, whose speeds change by 3.3e-3 and 1.5e-3, their orbits by less than the tolerance of 1e-3: of
// the first an orbit is followed, the second is solved again, as the term may give it another label.
TEST(CubicShift, OnARigidStopTheImpactSpeedIsKeptToo) {
    job::Job job = testing::job_170mm(238.2325);
    job.contact = job::Restitution{0.32};
    job.output.fields = {cell::OptionalField::impact_speed};
    for (const Place place :
         {Place{2.9126984126984126, 0.15873015873015872}, {4.3742138364779874, 1.069182389937107}}) {
        job.columns = {place.frequency_ratio, 5.0, 2};
        job.rows = {place.gap_ratio, 2.0, 2};
        job.solver.omit_tolerance = 1e-3;
        const CellResult cell = solve_cell(scene::Scene(job), 0, 0);
        job.solver.omit_tolerance = 0;
        const CellResult whole = solve_cell(scene::Scene(job), 0, 0);
        ASSERT_TRUE(same_label(cell, whole));
        EXPECT_NEAR(cell.impact_speed / whole.impact_speed, 1, 1e-6) << place.frequency_ratio;
        EXPECT_NE(cell.engine, Engine::exact) << place.frequency_ratio;
    }
}

// The second search measures the speed, too: without it each such cell would be solved a third time.
TEST(CubicShift, OnARigidStopACellIsNotSolvedAThirdTimeInVain) {
    job::Job job = testing::job_170mm(238.2325);
    job.contact = job::Restitution{0.32};
    job.output.fields = {cell::OptionalField::impact_speed};
    job.columns = {3.3427672955974845, 5.0, 2};
    job.rows = {0.0, 2.0, 2};
    EXPECT_EQ(solve_cell(scene::Scene(job), 0, 0).engine, Engine::exact);
}

// Multipliers near 0 and weak impacts: 3 k3 u^2/k is 1e-4, but the force changes by 1.1 %.
TEST(CubicShift, IsNotBoundByThePartOfTheStiffnessThatIsLeftOut) {
    job::Job job = testing::job_170mm(238.23);
    job.columns = {4.39937106918239, 4.5, 2};
    job.rows = {1.0062893081761006, 2.0, 2};
    const CellResult cell = solve_cell(scene::Scene(job), 0, 0);
    job.solver.omit_tolerance = 0;
    const CellResult whole = solve_cell(scene::Scene(job), 0, 0);
    EXPECT_TRUE(same_label(cell, whole));
    EXPECT_NEAR(cell.peak_force / whole.peak_force, 1, 1e-8);
    EXPECT_EQ(cell.engine, Engine::split);
}

TEST(CubicShift, SparesASecondRunWhereItIsSmall) {
    job::Job job = testing::job_170mm(238.2325);
    job.columns = {0.94110275689223057, 2.0, 2};
    job.rows = {2.6190476190476191, 3.0, 2};
    const CellResult cell = solve_cell(scene::Scene(job), 0, 0);
    EXPECT_EQ(cell.engine, Engine::exact);
    job.solver.omit_tolerance = 5e-4;  // the term changes the peak force by 8.8e-4
    EXPECT_EQ(solve_cell(scene::Scene(job), 0, 0).engine, Engine::split);
}

}  // namespace
}  // namespace peterka::regime
