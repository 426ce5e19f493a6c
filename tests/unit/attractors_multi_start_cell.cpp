// A cell with many starts against a separate search for
// each of them, and its critical kick against single kicks.
#include "attractors/multi_start_cell.hpp"

#include <gtest/gtest.h>

#include <map>
#include <utility>
#include <vector>

#include "attractors/drawn_cells.hpp"
#include "attractors/start_sequence.hpp"
#include "regime/same_attractor.hpp"
#include "regime/scalar_engine.hpp"
#include "regime/solve_cell.hpp"
#include "rig.hpp"

namespace peterka::attractors {
namespace {

using regime::CellResult;
using regime::Regime;

// 1/1 beside no impact, on the paper's 150 mm rig without its cubic spring.
job::Job two_attractors(std::int64_t starts) {
    job::Job job = testing::job_170mm(0);
    job.hammer.natural_frequency_hz = testing::beam_150mm.natural_frequency_hz;
    job.hammer.damping_ns_per_m = testing::beam_150mm.damping_ns_per_m;
    job.columns = {1.8, 2.8, 2};
    job.rows = {1.6, 2.6, 2};
    job.starts.count = starts;
    return job;
}

// 1/2 beside no impact, reached by one start in twenty.
job::Job two_found(std::int64_t starts) {
    job::Job job = testing::job_170mm(0);
    job.columns = {3, 4, 2};
    job.rows = {1.5, 2.5, 2};
    job.starts.count = starts;
    return job;
}

SolvedCell searched(const job::Job& job, Ends ends = Ends::counted) {
    const scene::Scene scene(job);
    const regime::AttractorTable nothing;
    const MapContext context(scene, nothing, ends);
    MultiStartCell cell(context, 0, 0);
    SearchBroker searches;
    const auto task = cell.solve(searches);
    for (task.start(); !task.done();) {
        std::vector<SearchOutcome> ended;
        for (const SearchFactory& begin : searches.ordered()) {
            regime::CycleBroker broker;
            ended.push_back(regime::complete(begin(broker), broker));
        }
        searches.serve(std::move(ended));
    }
    return task.result();
}

TEST(MultiStartCell, SharesAreThoseOfSingleSearches) {
    constexpr std::int64_t count = 40;
    const job::Job job = two_found(count);
    const scene::Cell cell = scene::Scene(job).cell(0, 0);
    std::map<std::pair<Regime, std::int32_t>, std::int64_t> alone;
    std::vector<CellResult> ends;
    for (std::int64_t n = 0; n < count; ++n) {
        ends.push_back(regime::find_steady_state(cell.oscillator, start_of(job.starts, cell, n), {}));
        ++alone[{ends.back().regime, ends.back().impacts}];
    }
    ASSERT_EQ(alone.size(), 2U);

    const SolvedCell solved = searched(job, Ends::told);
    ASSERT_EQ(solved.ends.size(), ends.size());
    for (std::size_t n = 0; n < ends.size(); ++n) {
        EXPECT_TRUE(regime::same_attractor(solved.ends[n], ends[n])) << n;
    }
    EXPECT_EQ(solved.cell.attractors, 2);
    ASSERT_EQ(solved.attractors.size(), 2U);
    EXPECT_GE(solved.attractors[0].share, solved.attractors[1].share);
    for (const CellAttractor& attractor : solved.attractors) {
        const auto starts = alone.at({attractor.regime, attractor.impacts});
        EXPECT_EQ(attractor.share, static_cast<double>(starts) / count);
    }
    const CellResult own = regime::find_steady_state(cell.oscillator, cell.start, {});
    EXPECT_TRUE(same_label(solved.cell, own));
    EXPECT_EQ(solved.attractors.at(static_cast<std::size_t>(solved.cell.start_attractor)).regime, own.regime);
    std::int64_t cycles = own.cycles;
    for (const CellResult& end : ends) cycles += end.cycles;
    EXPECT_LT(solved.cell.cycles, cycles);  // later starts use what earlier ones found
    EXPECT_GT(solved.cell.cycles, own.cycles + count);
}

TEST(MultiStartCell, TheFirstStartOnEachAttractorIsTold) {
    const job::Job job = two_found(40);
    const SolvedCell told = searched(job, Ends::told);
    const SolvedCell firsts = searched(job, Ends::firsts);
    ASSERT_EQ(firsts.firsts.size(), firsts.attractors.size());
    for (const FirstEnd& first : firsts.firsts) {
        ASSERT_GE(first.start, 0);
        for (std::int64_t n = 0; n <= first.start; ++n) {
            const bool is_it = regime::same_attractor(told.ends[static_cast<std::size_t>(n)], first.result);
            EXPECT_EQ(is_it, n == first.start) << n;
        }
    }
}

// Without starts the cell's own motion is kicked: it returns just below the critical kick and does not at it.
TEST(MultiStartCell, TheSmallestKickParts) {
    job::Job job = two_attractors(0);
    job.output.fields = {job::OptionalField::critical_kick};
    const scene::Cell cell = scene::Scene(job).cell(0, 0);
    job.start.velocity_ratio = 1;
    const SolvedCell solved = searched(job);
    ASSERT_EQ(solved.cell.regime, Regime::periodic);
    EXPECT_EQ(solved.cell.attractors, 0);
    const cell::Kick& kick = solved.cell.kick;
    ASSERT_GT(kick.size, 0);
    KickedOrbit orbit(cell.oscillator, {0, {}, solved.cell});
    const auto end_of = [&](double size) {
        const auto start = orbit.after({kick.phase, kick.direction * size});
        EXPECT_TRUE(start.done());
        return regime::find_steady_state(cell.oscillator, start.state, {});
    };
    EXPECT_FALSE(regime::same_attractor(end_of(kick.size), solved.cell));
    EXPECT_TRUE(regime::same_attractor(end_of(kick.size * 0.99), solved.cell));
}

// Each drawn rig ends as in a search of its own, from [start] or from a start of its own.
TEST(MultiStartCell, DrawnRigsEndAsInSingleSearches) {
    for (const std::int64_t starts : {0, 12}) {
        job::Job job = two_attractors(starts);
        job.uncertainty.rigs = 24;
        job.uncertainty.numbers["contact.damping_ns_per_m"].relative = 0.2;
        job.uncertainty.numbers["hammer.natural_frequency_hz"].relative = 0.02;
        const SolvedCell solved = searched(job, Ends::told);
        const scene::Scene scene(job);
        const scene::UncertainCells uncertain(job);
        const DrawnCells drawn(uncertain, job, 0, 0, scene.scales());
        std::map<std::pair<Regime, std::int32_t>, double> expected;
        ASSERT_EQ(solved.ends_of_rigs.size(), 24U);
        for (std::int64_t n = 0; n < drawn.count(); ++n) {
            regime::CycleBroker broker;
            const CellResult alone = regime::complete(regime::solve_cell(broker, job, drawn.cell(n)), broker);
            EXPECT_TRUE(regime::same_attractor(solved.ends_of_rigs[static_cast<std::size_t>(n)], alone)) << n;
            expected[{alone.regime, alone.impacts}] += 1.0 / 24;
        }
        ASSERT_EQ(solved.outcomes.size(), expected.size());
        for (const CellOutcome& outcome : solved.outcomes)
            EXPECT_NEAR(outcome.probability, (expected[{outcome.regime, outcome.impacts}]), 1e-12);
    }
}

TEST(MultiStartCell, DrawnRigsLeaveItsOwnResultAlone) {
    job::Job job = two_attractors(12);
    const SolvedCell without = searched(job);
    job.uncertainty.rigs = 24;
    job.uncertainty.numbers["contact.damping_ns_per_m"].relative = 0.2;
    const SolvedCell with = searched(job);
    EXPECT_EQ(with.cell.peak_force, without.cell.peak_force);
    EXPECT_EQ(with.cell.attractors, without.cell.attractors);
    ASSERT_EQ(with.attractors.size(), without.attractors.size());
    for (std::size_t i = 0; i < with.attractors.size(); ++i)
        EXPECT_EQ(with.attractors[i].share, without.attractors[i].share);
}

}  // namespace
}  // namespace peterka::attractors
