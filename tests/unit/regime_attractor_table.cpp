// Prior knowledge of a basin's attractors, and its use by a search.
#include "regime/attractor_table.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "known_attractors.hpp"
#include "regime/scalar_engine.hpp"
#include "rig.hpp"

namespace peterka::regime {
namespace {

using testing::beam_150mm;
using testing::found_from;
using testing::paper_rig;
using testing::solve_knowing;

constexpr double many = 1e4;  // starts for each one run in full

scene::Oscillator<double> coexisting() {
    return paper_rig(beam_150mm, 1.8, 1.6);
}

TEST(AttractorTable, AStartThatFallsIntoANeighbourhoodTakesTheAttractorsValues) {
    const auto oscillator = coexisting();
    const auto found = found_from(oscillator, -1, 1);
    ASSERT_EQ(found.size(), 1U);
    ASSERT_EQ(found.front().result.regime, Regime::periodic);
    const AttractorTable known(oscillator, found, many);
    std::int64_t cycles = 0;
    std::int64_t in_full = 0;
    for (double velocity = -4; velocity <= 4; velocity += 0.25) {
        SCOPED_TRACE(velocity);
        const CellResult full = testing::solve(oscillator, -1, velocity);
        const CellResult short_cut = solve_knowing(known, oscillator, -1, velocity);
        EXPECT_EQ(short_cut.regime, full.regime);
        EXPECT_EQ(short_cut.impacts, full.impacts);
        EXPECT_EQ(short_cut.period, full.period);
        EXPECT_EQ(short_cut.status, Status::verified);
        EXPECT_LE(short_cut.cycles, full.cycles);
        cycles += short_cut.cycles;
        in_full += full.cycles;
        if (full.regime != Regime::periodic) continue;
        EXPECT_EQ(short_cut.peak_force, found.front().result.peak_force);  // to the last bit
        EXPECT_EQ(short_cut.orbit_displacement, found.front().result.orbit_displacement);
        EXPECT_NEAR(short_cut.peak_force / full.peak_force, 1, 1e-9);
    }
    EXPECT_LT(cycles, in_full * 2 / 3);
}

TEST(AttractorTable, AStartOnTheOrbitItselfTakesNoCycle) {
    const auto oscillator = coexisting();
    const auto found = found_from(oscillator, -1, 1);
    const AttractorTable known(oscillator, found, many);
    const CellResult& orbit = found.front().result;
    EXPECT_EQ(
        solve_knowing(known, oscillator, orbit.orbit_displacement, orbit.orbit_velocity + oscillator.frequency)
            .cycles,
        0);
}

TEST(AttractorTable, KnowsNothingOfAnotherMap) {
    const auto oscillator = coexisting();
    const AttractorTable known(oscillator, found_from(oscillator, -1, 1), many);
    EXPECT_NE(known.of(oscillator, {}), nullptr);
    EXPECT_EQ(known.of(oscillator, {.engine = Engine::arkode}), nullptr);
    auto with_cubic = oscillator;
    with_cubic.cubic = 7.9e-7;
    EXPECT_EQ(known.of(with_cubic, {}), nullptr);
    EXPECT_EQ(AttractorTable().of(oscillator, {}), nullptr);
}

TEST(AttractorTable, MapsWithAsManyKicksAreOne) {
    auto oscillator = coexisting();
    oscillator.cubic = 7.9e-7;
    const EngineSettings settings{Engine::split, 1e-6, 5};
    const AttractorTable known(oscillator, found_from(oscillator, -1, 1, settings), many);
    EXPECT_NE(known.of(oscillator, settings), nullptr);
    EXPECT_EQ(known.of(oscillator, {Engine::split, 1e-6, 5.0000001}), known.of(oscillator, settings));
    EXPECT_EQ(known.of(oscillator, {Engine::split, 1e-9, 50}), nullptr);
}

// The tolerance sets an integrator's steps, but the kicks' number only as far as it is rounded.
TEST(AttractorTable, MapsOfIntegratorsAreTheSameAtOneTolerance) {
    auto oscillator = coexisting();
    oscillator.cubic = 7.9e-7;
    for (const Engine engine : {Engine::cvode, Engine::arkode}) {
        EXPECT_TRUE(same_map(oscillator, {engine, 1e-6, 5}, {engine, 1e-6, 50}));
        EXPECT_FALSE(same_map(oscillator, {engine, 1e-6, 5}, {engine, 1.01e-6, 5}));
    }
    EXPECT_TRUE(same_map(oscillator, {Engine::split, 1e-6, 5}, {Engine::split, 1.0000001e-6, 5}));
}

TEST(AttractorTable, HoldsOnlyOrbitsThatAreWorthTheirNeighbourhood) {
    const auto oscillator = coexisting();
    const auto impacting = found_from(oscillator, -1, 1);
    EXPECT_EQ(AttractorTable(oscillator, impacting, 1).of(oscillator, {}), nullptr);
    std::vector<FoundAttractor> none{impacting.front()};
    none.front().result.regime = Regime::no_impact;
    EXPECT_EQ(AttractorTable(oscillator, none, many).of(oscillator, {}), nullptr);
    none.front().result.regime = Regime::chaotic;
    EXPECT_EQ(AttractorTable(oscillator, none, many).of(oscillator, {}), nullptr);
    // one start found twice as often is worth twice as much
    const std::vector<FoundAttractor> often(20, impacting.front());
    EXPECT_NE(AttractorTable(oscillator, often, 10).of(oscillator, {}), nullptr);
    EXPECT_EQ(AttractorTable(oscillator, impacting, 10).of(oscillator, {}), nullptr);
}

}  // namespace
}  // namespace peterka::regime
