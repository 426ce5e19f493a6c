// A trace against the map's result for its cell, against balances, and against other engines.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "regime/solve_cell.hpp"
#include "rig.hpp"
#include "trace/trace.hpp"

namespace peterka::trace {
namespace {

using testing::job_170mm;

job::Job traced(double frequency_ratio, double gap_ratio, std::int64_t cycles = 4) {
    job::Job job = job_170mm(0);
    job.kind = job::Kind::trace;
    job.operating_point = {frequency_ratio, gap_ratio};
    job.trace.cycles = cycles;
    job.trace.samples_per_cycle = 200;
    job.trace.spectrum_to_hz = 500;
    return job;
}

Trace trace_of(const job::Job& job) {
    return make_trace(scene::Scene(job));
}

struct Place {
    double frequency_ratio;
    double gap_ratio;
    int impacts;
    int period;
};

class TraceOfOrbit : public ::testing::TestWithParam<Place> {};

// Three ways to the peak: the decision procedure's orbit, the largest impact of the trace, and the zero of
// the force's slope in the window.
TEST_P(TraceOfOrbit, HasThePeakForceOfTheMap) {
    const auto [frequency_ratio, gap_ratio, impacts, period] = GetParam();
    for (const auto engine : {job::EngineChoice::exact, job::EngineChoice::arkode}) {
        job::Job job = traced(frequency_ratio, gap_ratio, 4 * period);
        job.solver.engine = engine;
        const Trace trace = trace_of(job);
        ASSERT_EQ(trace.course.cell->impacts, impacts);
        ASSERT_EQ(trace.course.cell->period, period);
        EXPECT_EQ(trace.course.period, period);
        EXPECT_EQ(trace.impacts.size(), static_cast<std::size_t>(4 * impacts));
        const double peak = trace.course.cell->peak_force;
        EXPECT_NEAR(trace.impacts[trace.hardest->index].record.peak_force / peak, 1, 1e-9);
        EXPECT_NEAR(quantities(trace.course.oscillator, trace.hardest->peak).force / peak, 1, 1e-9);
    }
}

INSTANTIATE_TEST_SUITE_P(Cells, TraceOfOrbit,
                         ::testing::Values(Place{2, 0, 1, 1}, Place{12.25 / 4.5, 0, 2, 2},
                                           Place{15.25 / 4.5, 0, 1, 2}, Place{3.1, 0, 3, 2}));

// A map observes a non-periodic motion after half of a small budget: so does a trace. Few cycles, because in
// chaos rounding errors grow by about e^0.5 in each.
TEST(Trace, OfAMotionWithoutAPeriodShowsTheCyclesThatAMapCounts) {
    job::Job job = traced(3.1031746, 0.3968254, 15);
    job.steady_state.max_cycles = 30;
    const Trace trace = trace_of(job);
    ASSERT_EQ(trace.course.cell->regime, regime::Regime::unresolved);
    EXPECT_EQ(trace.course.skipped, 15);
    EXPECT_NEAR(trace.impacts[trace.hardest->index].record.peak_force / trace.course.cell->peak_force, 1, 1e-9);
    EXPECT_NEAR(static_cast<double>(trace.impacts.size()) / 15, trace.course.cell->impact_rate, 1e-12);
}

TEST(Trace, OfChaosBeginsAfterItsTransient) {
    const Trace trace = trace_of(traced(3.1031746, 0.3968254, 15));
    ASSERT_EQ(trace.course.cell->regime, regime::Regime::chaotic);
    EXPECT_EQ(trace.course.skipped, 100);
    EXPECT_GT(trace.course.cell->lyapunov, 0);
    EXPECT_EQ(trace.course.period, 0);
}

// Two impacts of alternating strength: a map's mean over the cycles is that of both.
TEST(Trace, HasTheForcesPerCycleOfTheMap) {
    job::Job job = traced(12.25 / 4.5, 0, 2);
    job.output.fields = {job::OptionalField::force_per_cycle};
    const regime::CellResult cell = regime::solve_cell(scene::Scene(job), 0, 0);
    const Trace trace = trace_of(job);
    ASSERT_EQ(trace.impacts.size(), 2U);
    const double one = trace.impacts[0].record.peak_force;
    const double other = trace.impacts[1].record.peak_force;
    EXPECT_GT(std::abs(one - other), 0.01 * one);
    EXPECT_NEAR(cell.peak_force_mean, (one + other) / 2, 1e-9 * one);
    EXPECT_NEAR(cell.peak_force_q95, std::max(one, other), 1e-9 * one);
}

double energy(const Instant& instant, const scene::Oscillator<double>& oscillator) {
    const double u = instant.state[0] + oscillator.gap;
    return (instant.state[1] * instant.state[1] + u * u) / 2;
}

TEST(Trace, BalancesEnergy) {
    for (const double eta : {2.0, 3.1, 0.75}) {
        job::Job job = traced(eta, 0.4, 20);
        job.trace.from = job::TraceBegin::start;
        const Trace trace = trace_of(job);
        ASSERT_GT(trace.impacts.size(), 5U);
        double into_stop = 0;
        for (const Impact& impact : trace.impacts) into_stop += impact.record.work;
        const double gained = energy(trace.instants.back(), trace.course.oscillator) -
                              energy(trace.instants.front(), trace.course.oscillator);
        const double scale = trace.totals.drive_work + into_stop;
        EXPECT_NEAR(gained, trace.totals.drive_work - trace.totals.damper_work - into_stop, 1e-11 * scale);
    }
}

TEST(Trace, IsTheSameByEveryEngine) {
    job::Job job = traced(3.1, 0.2, 3);
    job.trace.from = job::TraceBegin::start;
    const Trace exact = trace_of(job);
    for (const auto engine : {job::EngineChoice::split, job::EngineChoice::cvode, job::EngineChoice::arkode}) {
        job.solver.engine = engine;
        const Trace other = trace_of(job);
        ASSERT_EQ(other.instants.size(), exact.instants.size());
        ASSERT_EQ(other.impacts.size(), exact.impacts.size());
        for (std::size_t n = 0; n < exact.instants.size(); ++n) {
            EXPECT_EQ(other.instants[n].time, exact.instants[n].time);
            EXPECT_LT((other.instants[n].state - exact.instants[n].state).norm(), 1e-6) << n;
        }
    }
}

// Its states lie off the motion between kicks: a start of
// -1 appeared as -0.9999998, and flights were off by 6e-6.
TEST(Trace, OfSplitSpringsShowsTheMotionAndNotItsKicks) {
    job::Job job = traced(2, 1, 2);
    job.hammer.cubic_stiffness_n_per_m3 = 238.2325;
    job.trace.from = job::TraceBegin::start;
    job.start = {-3, 1};
    job.solver.omit_tolerance = 0;
    job.solver.tolerance = 1e-6;  // few kicks
    job.solver.engine = job::EngineChoice::split;
    const Trace split = trace_of(job);
    EXPECT_NEAR(split.instants.front().state[1] + split.course.oscillator.frequency, 1, 1e-14);
    job.solver.engine = job::EngineChoice::cvode;
    job.solver.tolerance = 1e-10;
    const Trace whole = trace_of(job);
    ASSERT_EQ(whole.instants.size(), split.instants.size());
    for (std::size_t n = 0; n < 40; ++n) {  // before the first impact
        EXPECT_EQ(split.instants[n].phase, trajectory::Phase::flight);
        EXPECT_NEAR(split.instants[n].state[1], whole.instants[n].state[1], 1e-6) << n;
    }
}

TEST(Trace, HasAsManySamplesOfTheHardestImpactAsAskedFor) {
    for (const std::int64_t samples : {10, 999, 1000, 2000}) {
        job::Job job = traced(2, 0);
        job.trace.impact_samples = samples;
        EXPECT_EQ(std::ssize(trace_of(job).hardest->instants), samples);
    }
}

TEST(Trace, SamplesEvenlyFromEndToEnd) {
    const Trace trace = trace_of(traced(2, 0, 3));
    ASSERT_EQ(trace.instants.size(), 601U);
    for (std::size_t n = 0; n < trace.instants.size(); ++n) {
        EXPECT_NEAR(trace.instants[n].time, static_cast<double>(n) / 200 * std::numbers::pi, 1e-12);
    }
    EXPECT_LT((trace.instants.back().state - trace.instants.front().state).norm(), 1e-9);  // the orbit closes
}

TEST(Trace, ShowsTheJumpOfTheForceAtTouch) {
    const Trace trace = trace_of(traced(2, 0));
    const HardImpact& hardest = *trace.hardest;
    const Impact& impact = trace.impacts[hardest.index];
    const auto touch = std::ranges::find_if(
        hardest.instants, [&](const Instant& instant) { return std::abs(instant.time - impact.time) < 1e-12; });
    ASSERT_NE(touch, hardest.instants.end());
    ASSERT_NE(touch, hardest.instants.begin());
    const auto force = [&](const Instant& instant) {
        return quantities(trace.course.oscillator, instant).force;
    };
    EXPECT_NEAR(force(*touch) / force_at_touch(trace.course.oscillator, impact.speed), 1, 1e-12);
    EXPECT_EQ(force(*(touch - 1)), 0);
}

// The acceleration matches the motion: x over three neighbouring samples of free flight.
TEST(Trace, AcceleratesAsItMoves) {
    job::Job job = traced(1.7, 5, 1);
    job.trace.samples_per_cycle = 2000;
    const Trace trace = trace_of(job);
    const double step = trace.instants[1].time;
    for (std::size_t n = 1; n + 1 < trace.instants.size(); n += 97) {
        const auto x = [&](std::size_t i) {
            return quantities(trace.course.oscillator, trace.instants[i]).hammer();
        };
        EXPECT_NEAR((x(n + 1) - 2 * x(n) + x(n - 1)) / (step * step),
                    quantities(trace.course.oscillator, trace.instants[n]).acceleration, 1e-4);
    }
}

TEST(Trace, OfARigidStopHasImpactsWithoutAForce) {
    job::Job job = traced(2, 0.5);
    job.contact = job::Restitution{0.6};
    const Trace trace = trace_of(job);
    ASSERT_EQ(trace.impacts.size(), 4U);
    for (const Impact& impact : trace.impacts) {
        EXPECT_TRUE(std::isnan(impact.record.peak_force));
        EXPECT_NEAR(impact.record.impulse, 1.6 * impact.speed, 1e-12);
    }
    EXPECT_FALSE(trace.hardest->spectrum);
}

TEST(Trace, KeepsACubicSpringWhereAMapDoes) {
    job::Job job = traced(2, 0);
    job.hammer.cubic_stiffness_n_per_m3 = 238.2325;
    EXPECT_EQ(trace_of(job).course.oscillator.cubic, 0);
    job.solver.omit_tolerance = 0;
    const Trace kept = trace_of(job);
    EXPECT_GT(kept.course.oscillator.cubic, 0);
    EXPECT_EQ(kept.course.settings.engine, regime::Engine::split);
    EXPECT_NEAR(kept.impacts[kept.hardest->index].record.peak_force / kept.course.cell->peak_force, 1, 1e-9);
}

}  // namespace
}  // namespace peterka::trace
