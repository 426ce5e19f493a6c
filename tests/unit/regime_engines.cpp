// Engines behind one decision procedure: they agree where their scenes are the same, and the rule that
// selects an engine omits the cubic spring only where that is safe.
#include "regime/engine.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "regime/solve_cell.hpp"
#include "rig.hpp"

namespace peterka::regime {
namespace {

using testing::beam_170mm;
using testing::paper_cubic;
using testing::paper_rig;
using testing::start_at;

struct EngineCase {
    Engine engine;
    double tolerance;
};

std::string name_of(const ::testing::TestParamInfo<EngineCase>& info) {
    const std::string names[] = {"exact", "split", "cvode", "arkode"};
    return names[static_cast<std::size_t>(info.param.engine)] + "_1e" +
           std::to_string(static_cast<int>(std::lround(-std::log10(info.param.tolerance))));
}

class Engines : public ::testing::TestWithParam<EngineCase> {
  protected:
    [[nodiscard]] static CellResult solve(const scene::Oscillator<double>& oscillator) {
        return find_steady_state(oscillator, start_at(oscillator), {},
                                 {GetParam().engine, GetParam().tolerance, 10});
    }
};

// Some engines fail here at every tolerance: a hop hidden between two steps.
TEST_P(Engines, SeeTheShortHop) {
    const CellResult cell = solve(paper_rig(beam_170mm, 3.1, 0));
    EXPECT_EQ(cell.impacts, 3);
    EXPECT_EQ(cell.period, 2);
    EXPECT_EQ(cell.engine, GetParam().engine);
}

TEST_P(Engines, AgreeWithTheClosedForm) {
    const std::pair<double, double> places[] = {{2.0, 0},  {1.3, 1.0}, {1.1, 4.0}, {3.5, 0.3},
                                                {2.75, 0}, {0.8, 0.2}, {4.2, 0.5}, {0.6, 0.8}};
    for (const auto& [frequency, gap] : places) {
        SCOPED_TRACE(::testing::Message() << frequency << " " << gap);
        const auto oscillator = paper_rig(beam_170mm, frequency, gap);
        const CellResult expected = find_steady_state(oscillator, start_at(oscillator), {});
        const CellResult cell = solve(oscillator);
        EXPECT_EQ(cell.regime, expected.regime);
        EXPECT_EQ(cell.impacts, expected.impacts);
        EXPECT_EQ(cell.period, expected.period);
        EXPECT_NEAR(cell.peak_force, expected.peak_force, 2 * GetParam().tolerance * expected.peak_force);
    }
}

INSTANTIATE_TEST_SUITE_P(All, Engines,
                         ::testing::Values(EngineCase{Engine::split, 1e-9}, EngineCase{Engine::cvode, 1e-5},
                                           EngineCase{Engine::cvode, 1e-8}, EngineCase{Engine::arkode, 1e-5},
                                           EngineCase{Engine::arkode, 1e-8}),
                         name_of);

// With a cubic spring the engines that keep it agree with each other, and none agrees with the closed form.
TEST(CubicSpring, ShiftsTheForceAlikeInEveryEngine) {
    for (const auto form : {job::CubicForm::relative, job::CubicForm::absolute}) {
        auto oscillator = paper_rig(beam_170mm, 2.0, 0.0);
        const double linear = find_steady_state(oscillator, start_at(oscillator), {}).peak_force;
        oscillator.cubic = 100 * paper_cubic;
        oscillator.cubic_form = form;
        const auto force = [&](Engine engine, double tolerance) {
            const CellResult cell =
                find_steady_state(oscillator, start_at(oscillator), {}, {engine, tolerance, 8});
            EXPECT_EQ(cell.impacts, 1);
            EXPECT_EQ(cell.period, 1);
            return cell.peak_force;
        };
        const double kept = force(Engine::cvode, 1e-8);
        EXPECT_GT(std::abs(kept / linear - 1), 1e-4);
        EXPECT_NEAR(force(Engine::arkode, 1e-8) / kept, 1, 2e-8);
        // the moving cart makes the absolute form more expensive to split
        const double tolerance = form == job::CubicForm::relative ? 1e-6 : 1e-4;
        EXPECT_NEAR(force(Engine::split, tolerance) / kept, 1, tolerance);
    }
}

// If required to split a cubic that is too strong, a cell fails rather than miss the requested accuracy.
TEST(CubicSpring, TooStrongToSplitIsAFailedCell) {
    auto oscillator = paper_rig(beam_170mm, 2.0, 0.0);
    oscillator.cubic = 1;
    const CellResult cell = find_steady_state(oscillator, start_at(oscillator), {}, {Engine::split, 1e-9, 8});
    EXPECT_EQ(cell.regime, Regime::failed);
    EXPECT_EQ(cell.status, Status::solver_failed);
}

TEST(CubicSpring, NoImpactIsProvedWithIt) {
    auto oscillator = paper_rig(beam_170mm, 3.0, 2.0);
    oscillator.cubic = paper_cubic;
    const CellResult cell = find_steady_state(oscillator, start_at(oscillator), {}, {Engine::split, 1e-9, 10});
    EXPECT_EQ(cell.regime, Regime::no_impact);
    EXPECT_NEAR(cell.multiplier, std::exp(-oscillator.damping_ratio * oscillator.period()), 1e-6);
    // a hardening spring moves the resonance up: above it the free amplitude grows
    oscillator.gap = testing::free_amplitude(oscillator) * (1 - 1e-4);
    EXPECT_NE(find_steady_state(oscillator, start_at(oscillator), {}, {Engine::split, 1e-9, 10}).regime,
              Regime::no_impact);
}

job::Job paper_job(double cubic_stiffness) {
    job::Job job = testing::job_170mm(cubic_stiffness);
    job.columns = {1.5, 2.5, 3};
    job.rows = {0.0, 1.0, 3};
    return job;
}

TEST(AutomaticEngine, IntegratesNoSpringsWithoutACubic) {
    const EngineByReach engine(paper_rig(beam_170mm, 2, 0.5), {.engine = job::EngineChoice::automatic}, 7);
    EXPECT_EQ(engine.settings().engine, Engine::split);
}

TEST(AutomaticEngine, LeavesThePapersCubicOut) {
    const CellResult with = solve_cell(scene::Scene(paper_job(238.2325)), 0, 1);
    const CellResult without = solve_cell(scene::Scene(paper_job(0)), 0, 1);
    EXPECT_EQ(with.engine, Engine::exact);
    EXPECT_EQ(with.peak_force, without.peak_force);
}

TEST(AutomaticEngine, KeepsEveryTermWhereNothingMayBeLeftOut) {
    job::Job job = paper_job(238.2325);
    job.solver.omit_tolerance = 0;
    const CellResult kept = solve_cell(scene::Scene(job), 0, 1);
    EXPECT_EQ(kept.engine, Engine::split);
    const double linear = solve_cell(scene::Scene(paper_job(0)), 0, 1).peak_force;
    EXPECT_GT(std::abs(kept.peak_force / linear - 1), 1e-6);
    EXPECT_LT(std::abs(kept.peak_force / linear - 1), 2e-4);
}

TEST(AutomaticEngine, SolvesAgainWhereTheTermMatters) {
    EXPECT_NE(solve_cell(scene::Scene(paper_job(238.2325e4)), 0, 1).engine, Engine::exact);
    EXPECT_EQ(solve_cell(scene::Scene(paper_job(238.2325e7)), 0, 1).engine, Engine::arkode);
}

// The fold of 1/1 is so close that the term changes the peak
// force by 1.5e-3, though it changes the stiffness by 7e-5.
TEST(AutomaticEngine, KeepsTheTermNextToAFold) {
    job::Job job = paper_job(238.23);
    job.columns = {1.8463796477495107, 2.0, 2};
    job.rows = {1.5362035225048922, 2.0, 2};
    const CellResult kept = solve_cell(scene::Scene(job), 0, 0);
    EXPECT_EQ(kept.engine, Engine::split);
    const CellResult independent = solve_again(scene::Scene(job), 0, 0, kept.engine);
    EXPECT_NEAR(kept.peak_force / independent.peak_force, 1, 1e-7);
    job.hammer.cubic_stiffness_n_per_m3 = 0;
    EXPECT_GT(std::abs(solve_cell(scene::Scene(job), 0, 0).peak_force / independent.peak_force - 1), 1e-3);
}

// Cells with the start at rest whose way grows small effects up to e^17 times: without the term it leads to
// another regime, and so it does with the term and errors of the default omit_tolerance. Expected are the
// regimes of Taylor series with the term, in long double and in 113 bits, with an event search of their own.
TEST(AutomaticEngine, KeepsTheTermWhereItTurnsTheWay) {
    struct Place {
        double frequency, gap;
        int impacts, period;
        Status status = Status::verified;
    };
    // the first one's growth leaves of the tolerance, 1e-9, more than 0.02 A0
    for (const auto& [frequency, gap, impacts, period, status] :
         {Place{3.888235294117647, 1.2941176470588236, 4, 9, Status::rounding},
          Place{1.6294117647058823, 2.235294117647059, 0, 1},
          Place{1.5666666666666667, 2.588235294117647, 0, 1}}) {
        SCOPED_TRACE(::testing::Message() << frequency << " " << gap);
        job::Job job = paper_job(238.23);
        job.columns = {frequency, 5, 2};
        job.rows = {gap, 5, 2};
        const CellResult kept = solve_cell(scene::Scene(job), 0, 0);
        EXPECT_EQ(kept.engine, Engine::split);
        EXPECT_EQ(kept.status, status);
        EXPECT_EQ(kept.impacts, impacts);
        EXPECT_EQ(kept.period, period);
    }
}

// Both ways lead to 7/12, but that with the term grows its search's errors beyond what is harmless; Taylor
// series in long double don't settle there.
TEST(AutomaticEngine, CallsNoLabelVerifiedThatItsOwnSearchMayHaveMissed) {
    job::Job job = paper_job(238.23);
    job.columns = {2.9941176470588236, 5, 2};
    job.rows = {0.8627450980392157, 5, 2};
    const CellResult cell = solve_cell(scene::Scene(job), 0, 0);
    EXPECT_EQ(cell.engine, Engine::exact);
    EXPECT_EQ(cell.status, Status::rounding);
}

// A way that struck a rigid stop, and swings within less without the term at last; with it, z = 1/1.
TEST(AutomaticEngine, TakesTheTermsEffectAsFarAsTheWayWent) {
    job::Job job;
    job.hammer.mass_kg = 7.5146334882606425;
    job.hammer.natural_frequency_hz = 7.015922035399417;
    job.hammer.damping_ratio = 0.0021090179468262523;
    job.hammer.cubic_stiffness_n_per_m3 = -95673.77339168735;
    job.cart.amplitude_m = 0.0007194200285024795;
    job.contact = job::Restitution{0.3};
    job.columns = {1.7193647401512957, 5, 2};
    job.rows = {1.9535259404287746, 5, 2};
    const CellResult cell = solve_cell(scene::Scene(job), 0, 0);
    EXPECT_EQ(cell.impacts, 1);  // Taylor series in 113 bits
    EXPECT_EQ(cell.period, 1);
}

// A coarse search with the term ends on 3/2 although the way's growth is beyond what its errors allow; the
// finer one tells that rounding decides.
TEST(AutomaticEngine, VerifiesNothingThatItsErrorsMayHaveChosen) {
    job::Job job = paper_job(238.23);
    job.columns = {2.256862745098039, 5, 2};
    job.rows = {1.7058823529411764, 5, 2};
    const CellResult cell = solve_cell(scene::Scene(job), 0, 0);
    EXPECT_EQ(cell.status, Status::rounding);
    EXPECT_GT(cell.sensitivity, rounding_decides);
}

// A nonlinear contact is always integrated, with every term, however small.
TEST(AutomaticEngine, IntegratesHuntCrossleyStops) {
    job::Job job = paper_job(238.2325);
    job.contact = job::HuntCrossley{1e9, 1.5, 0.5};
    const CellResult with = solve_cell(scene::Scene(job), 0, 1);
    EXPECT_EQ(with.engine, Engine::arkode);
    EXPECT_EQ(with.regime, Regime::periodic);
    job.hammer.cubic_stiffness_n_per_m3 = 0;
    EXPECT_GT(std::abs(solve_cell(scene::Scene(job), 0, 1).peak_force / with.peak_force - 1), 1e-7);
}

job::Job hunt_crossley_job(double exponent, double stiffness, double dissipation, double frequency,
                           double gap) {
    job::Job job;
    job.hammer = {.mass_kg = 0.3, .natural_frequency_hz = 4.5, .damping_ratio = 0.01};
    job.cart.amplitude_m = 1e-3;
    job.contact = job::HuntCrossley{stiffness, exponent, dissipation};
    job.columns = {frequency, frequency + 1, 2};
    job.rows = {gap, gap + 1, 2};
    job.solver.tolerance = 1e-6;
    return job;
}

// F/(m g).
double force_over_weight(const job::Job& job, const CellResult& cell) {
    const double omega = 2 * std::numbers::pi * *job.hammer.natural_frequency_hz;
    return cell.peak_force * omega * omega * job.cart.amplitude_m / 9.80665;
}

// Expected: DOP853 of a program of its own, tolerance 1e-13, event roots and Newton's method on the orbit.
TEST(HuntCrossleyStop, HasForcesWithinToleranceWhereTheContactIsStiffAndDamped) {
    job::Job swings =
        hunt_crossley_job(3.0, 1216389715504.3022, 5.5965343775204355, 4.583066325275967, 0.1516223763528861);
    swings.hammer = {.mass_kg = 0.05174803715214935,
                     .natural_frequency_hz = 8.417627107076452,
                     .damping_ratio = 0.004824898792659594,
                     .cubic_stiffness_n_per_m3 = -2038814.3906694571,
                     .cubic = job::CubicForm::absolute};
    swings.cart.amplitude_m = 0.0005494274242416768;
    for (const auto& [job, expected] :
         {std::pair{hunt_crossley_job(1.5, 75841343.71480247, 353677.65131532296, 3.0, 0), 41.63560635},
          std::pair{hunt_crossley_job(2.5, 758413437148024.6, 3536.7765131532296, 3.0, 1e-3), 13.21403264},
          std::pair{swings, 9.239431932}}) {
        const CellResult cell = solve_cell(scene::Scene(job), 0, 0);
        EXPECT_NEAR(force_over_weight(job, cell) / expected, 1, 1e-6);
    }
}

// The orbit's force at this tolerance and at the next sharper one are 2e-5 apart: it may still be off.
TEST(HuntCrossleyStop, SaysWhereItsForceMayBeOff) {
    job::Job job = hunt_crossley_job(1.5, 75841343.71480247, 353677.65131532296, 3.0, 0);
    EXPECT_EQ(solve_cell(scene::Scene(job), 0, 0).status, Status::imprecise);
    job.contact = job::HuntCrossley{75841343.71480247, 1.5, 353.0};
    EXPECT_EQ(solve_cell(scene::Scene(job), 0, 0).status, Status::verified);
}

// A preload of ten amplitudes against n = 10: the force is noise in each step, in which events can't be told.
TEST(HuntCrossleyStop, FailsWhereItsForceIsNoise) {
    const CellResult cell = solve_cell(scene::Scene(hunt_crossley_job(10.0, 1e30, 5.0, 0.6, -10)), 0, 0);
    EXPECT_EQ(cell.regime, Regime::failed);
    EXPECT_EQ(cell.status, Status::solver_failed);
}

// Errors of a stiff contact's flow grow to its rate times the local tolerance in the Jacobian. The same 1/1 at
// any of these stiffnesses, by the same program.
TEST(HuntCrossleyStop, IsNotTakenForChaoticWhereItIsExtremelyStiff) {
    for (const double stiffness : {1e14, 1e20, 1e24}) {
        const CellResult cell =
            solve_cell(scene::Scene(hunt_crossley_job(1.0, stiffness, 3.53677651315323, 2.2, 0)), 0, 0);
        EXPECT_EQ(cell.regime, Regime::periodic) << stiffness;
        EXPECT_NEAR(cell.multiplier, 0.482956, 1e-3) << stiffness;
    }
    const CellResult cell =
        solve_cell(scene::Scene(hunt_crossley_job(1.0, 1e30, 3.53677651315323, 2.2, 0)), 0, 0);
    EXPECT_EQ(cell.status, Status::solver_failed);  // beyond what double precision tells
}

TEST(AutomaticEngine, DoesWhatItIsTold) {
    job::Job job = paper_job(0);
    job.solver.engine = job::EngineChoice::arkode;
    EXPECT_EQ(solve_cell(scene::Scene(job), 0, 1).engine, Engine::arkode);
}

}  // namespace
}  // namespace peterka::regime
