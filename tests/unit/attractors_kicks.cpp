// Kicks of several motions side by side: the start of each
// search, and the assignment of its end to its own motion.
#include "attractors/kicks.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>
#include <vector>

#include "rig.hpp"

namespace peterka::attractors {
namespace {

using regime::CellResult;
using regime::Regime;

struct Kicked {
    scene::Oscillator<double> oscillator;
    std::vector<Tally::Entry> entries;
};

Tally::Entry entry_of(const CellResult& result, bool has_orbit) {
    Tally::Entry entry;
    entry.result = result;
    if (has_orbit) entry.orbit = regime::FoundAttractor{0, {}, result};
    return entry;
}

// 1/1 of the paper's rig at gap 0 in slots 1 and 3; motions that cannot be kicked in slots 0 and 2.
Kicked two_orbits() {
    Kicked kicked{testing::paper_rig(testing::beam_170mm, 2, 0), {}};
    const CellResult orbit = testing::solve(kicked.oscillator);
    EXPECT_EQ(orbit.regime, Regime::periodic);
    CellResult chaos;
    chaos.regime = Regime::chaotic;
    kicked.entries = {entry_of(chaos, false), entry_of(orbit, true), entry_of(chaos, false),
                      entry_of(orbit, true)};
    return kicked;
}

CellResult elsewhere() {
    CellResult result;
    result.regime = Regime::no_impact;
    result.cycles = 30;
    return result;
}

TEST(Kicks, EndsOfSearchesGoBackToTheirOwnMotion) {
    const Kicked kicked = two_orbits();
    const regime::AttractorTable known;
    std::size_t starts = 0;
    const KickedCell cell{kicked.oscillator, 4, known, [&](const scene::State<double>&) {
                              ++starts;
                              return SearchFactory{};
                          }};
    SearchBroker broker;
    const auto task = smallest_kicks(broker, cell, kicked.entries);
    task.start();
    std::size_t rounds = 0;
    for (; !task.done(); ++rounds) {
        const std::size_t count = broker.ordered().size();
        ASSERT_EQ(count, std::exchange(starts, 0));
        std::vector<SearchOutcome> ended(count, {.result = kicked.entries[1].result});
        // in the first round each of the two has 32 kicks: all
        // of the first return, and one of the second does not
        if (rounds == 0) {
            ASSERT_EQ(count, 64U);
            ended.back() = {.result = elsewhere()};
            ended[3].result.regime = Regime::failed;  // gives no information
            ended[3].result.status = cell::Status::solver_failed;
        }
        broker.serve(std::move(ended));
    }
    EXPECT_GT(rounds, 9U);
    const std::vector<cell::Kick> kicks = task.result();
    ASSERT_EQ(kicks.size(), 4U);
    EXPECT_TRUE(std::isnan(kicks[1].size));
    EXPECT_LE(kicks[1].tried, 4.0 / 256);  // the unknown end
    EXPECT_LE(kicks[3].size, 4.0 / 256);
    EXPECT_GT(kicks[3].size, 0);
    EXPECT_EQ(kicks[3].tried, kicks[3].size);
    for (const std::size_t slot : {0U, 2U}) {
        EXPECT_TRUE(std::isnan(kicks[slot].tried)) << slot;
        EXPECT_TRUE(std::isnan(kicks[slot].size)) << slot;
        EXPECT_EQ(kicks[slot].direction, 0) << slot;
    }
}

// A basin that ends at a speed in the downward direction
// only: its critical kick is found, with size and direction.
TEST(Kicks, TellsSizePhaseAndDirectionOfTheSmallest) {
    Kicked kicked = two_orbits();
    kicked.entries.resize(2);
    const CellResult& orbit = kicked.entries[1].result;
    KickedOrbit undisturbed(kicked.oscillator, *kicked.entries[1].orbit);
    const auto at_phase_0 = undisturbed.after({1.0, 0});
    ASSERT_TRUE(at_phase_0.done());
    const regime::AttractorTable known;
    std::vector<scene::State<double>> starts;
    const KickedCell cell{kicked.oscillator, 4, known, [&](const scene::State<double>& start) {
                              starts.push_back(start);
                              return SearchFactory{};
                          }};
    SearchBroker broker;
    const auto task = smallest_kicks(broker, cell, kicked.entries);
    task.start();
    while (!task.done()) {
        std::vector<SearchOutcome> ended;
        for (const auto& start : std::exchange(starts, {})) {
            const bool leaves = start[1] < at_phase_0.state[1] - 0.5;  // at the next phase 0
            ended.push_back({.result = leaves ? elsewhere() : orbit});
        }
        broker.serve(std::move(ended));
    }
    const cell::Kick smallest = task.result()[1];
    ASSERT_GT(smallest.size, 0);
    const auto start = undisturbed.after({smallest.phase, smallest.direction * smallest.size});
    ASSERT_TRUE(start.done());
    EXPECT_LT(start.state[1], at_phase_0.state[1] - 0.5);
    const auto smaller = undisturbed.after({smallest.phase, 0.998 * smallest.direction * smallest.size});
    ASSERT_TRUE(smaller.done());
    EXPECT_GT(smaller.state[1], at_phase_0.state[1] - 0.5);
    EXPECT_TRUE(std::isnan(smallest.lower));  // no neighbourhood is known
}

// A search that ended by its budget may have been on its way back.
TEST(Kicks, UnfinishedSearchesEndNowhere) {
    const Kicked kicked = two_orbits();
    const regime::AttractorTable known;
    const KickedCell cell{kicked.oscillator, 4, known,
                          [&](const scene::State<double>&) { return SearchFactory{}; }};
    SearchBroker broker;
    const auto task = smallest_kicks(broker, cell, kicked.entries);
    task.start();
    CellResult unfinished;
    unfinished.regime = Regime::unresolved;
    unfinished.status = cell::Status::budget;
    unfinished.cycles = 30;
    for (int rounds = 0; !task.done(); ++rounds) {
        ASSERT_LT(rounds, 1000);
        broker.serve(std::vector<SearchOutcome>(broker.ordered().size(), {.result = unfinished}));
    }
    const cell::Kick kick = task.result()[1];
    EXPECT_TRUE(std::isnan(kick.size));
    EXPECT_LT(kick.tried, 4.0 / 64);  // the smallest size that was tried
}

// Kicks downwards end elsewhere from one size on; of those half as large and more the end is unknown.
TEST(Kicks, AreTriedUpToOneWhoseEndIsUnknown) {
    Kicked kicked = two_orbits();
    kicked.entries.resize(2);
    const CellResult& orbit = kicked.entries[1].result;
    KickedOrbit undisturbed(kicked.oscillator, *kicked.entries[1].orbit);
    const double at_phase_0 = undisturbed.after({1.0, 0}).state[1];
    CellResult unfinished;
    unfinished.regime = Regime::unresolved;
    unfinished.cycles = 30;
    const regime::AttractorTable known;
    std::vector<scene::State<double>> starts;
    const KickedCell cell{kicked.oscillator, 4, known, [&](const scene::State<double>& start) {
                              starts.push_back(start);
                              return SearchFactory{};
                          }};
    SearchBroker broker;
    const auto task = smallest_kicks(broker, cell, kicked.entries);
    task.start();
    while (!task.done()) {
        std::vector<SearchOutcome> ended;
        for (const auto& start : std::exchange(starts, {})) {
            const double down = at_phase_0 - start[1];
            ended.push_back({.result = down > 0.5 ? elsewhere() : (down > 0.25 ? unfinished : orbit)});
        }
        broker.serve(std::move(ended));
    }
    const cell::Kick kick = task.result()[1];
    ASSERT_GT(kick.size, 0);
    EXPECT_LT(kick.tried, 0.8 * kick.size);
    EXPECT_GT(kick.tried, 0.3 * kick.size);
}

}  // namespace
}  // namespace peterka::attractors
