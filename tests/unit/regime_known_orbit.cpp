// A start that converges to a known orbit takes its values; one that does not is not assigned to it.
#include "regime/known_orbit.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <utility>
#include <vector>

#include "known_attractors.hpp"
#include "regime/attractor_table.hpp"
#include "regime/same_orbit.hpp"
#include "regime/scalar_engine.hpp"
#include "rig.hpp"

namespace peterka::regime {
namespace {

using testing::beam_150mm;
using testing::beam_170mm;
using testing::found_from;
using testing::paper_rig;
using testing::solve_knowing;

std::optional<KnownOrbit> orbit_of(const scene::Oscillator<double>& oscillator, const FoundAttractor& found) {
    CycleBroker broker;
    std::int64_t spent = 0;
    auto orbit = complete(find_known_orbit(broker, oscillator, found, &spent), broker);
    EXPECT_LE(spent, 6 * found.result.period);
    return orbit;
}

AttractorTable knowing(const scene::Oscillator<double>& oscillator, const FoundAttractor& found) {
    AttractorTable table;
    auto orbit = orbit_of(oscillator, found);
    EXPECT_TRUE(orbit.has_value());
    if (orbit) table.add(oscillator, found, std::move(*orbit));
    return table;
}

// Coexisting with no impact, and with an orbit of another period.
void expect_same_ends(const scene::Oscillator<double>& oscillator, const FoundAttractor& found) {
    const AttractorTable known = knowing(oscillator, found);
    std::int64_t cycles = 0;
    std::int64_t in_full = 0;
    int taken = 0;
    for (double velocity = -4; velocity <= 4; velocity += 0.25) {
        SCOPED_TRACE(velocity);
        const CellResult full = testing::solve(oscillator, -1, velocity);
        const CellResult shorter = solve_knowing(known, oscillator, -1, velocity);
        EXPECT_TRUE(same_label(shorter, full));
        if (full.regime != Regime::periodic || !same_orbit(full, found.result)) continue;
        EXPECT_EQ(shorter.orbit_displacement, found.result.orbit_displacement);  // to the last bit
        EXPECT_EQ(shorter.peak_force, found.result.peak_force);
        EXPECT_LE(shorter.cycles, full.cycles);
        cycles += shorter.cycles;
        in_full += full.cycles;
        ++taken;
    }
    EXPECT_GT(taken, 3);
    EXPECT_LT(cycles, in_full * 3 / 4);
}

TEST(KnownOrbit, AStartThatConvergesToItTakesItsValues) {
    const auto oscillator = paper_rig(beam_150mm, 1.8, 1.6);
    const auto found = found_from(oscillator, -1, 1);
    ASSERT_EQ(found.front().result.regime, Regime::periodic);
    expect_same_ends(oscillator, found.front());
}

TEST(KnownOrbit, OneOfSeveralCyclesIsSeenFromEachOfItsPoints) {
    const auto oscillator = paper_rig(beam_170mm, 2.55, 2.95);  // 1/2 beside no impact
    std::vector<FoundAttractor> found;
    for (double velocity = -4; velocity <= 4 && found.empty(); velocity += 0.5) {
        auto end = found_from(oscillator, -2, velocity);
        if (end.front().result.regime == Regime::periodic) found = std::move(end);
    }
    ASSERT_FALSE(found.empty());
    ASSERT_EQ(found.front().result.period, 2);
    const auto known = orbit_of(oscillator, found.front());
    ASSERT_TRUE(known.has_value());
    CycleBroker broker;
    const StroboscopicMap map(oscillator, {}, broker);
    const Point first = map.scaled(scene::State<double>(
        found.front().result.orbit_displacement - oscillator.gap, found.front().result.orbit_velocity));
    const auto here = known->seen_from(first + Point(1e-3, 0));
    ASSERT_TRUE(here.has_value());
    const auto there = known->seen_from(here->points[1] + Point(0, 1e-3));
    ASSERT_TRUE(there.has_value());
    EXPECT_EQ(here->points[0], there->points[1]);
    EXPECT_NEAR(here->multiplier, found.front().result.multiplier, 1e-6);
    EXPECT_NEAR(there->multiplier, here->multiplier, 1e-9);
    EXPECT_GT((here->jacobian - there->jacobian).norm(), 1e-3);
    EXPECT_FALSE(known->seen_from(first + Point(2, 0)).has_value());
}

TEST(KnownOrbit, AnOrbitNearByThatItDoesNotConvergeToIsNotTaken) {
    const auto oscillator = paper_rig(beam_150mm, 1.8, 1.6);
    auto found = found_from(oscillator, -1, 1).front();
    found.result.peak_force = 12345;
    // the orbit of a rig with a smaller gap, presented as one of this rig
    auto other = oscillator;
    other.gap -= 0.5;
    auto orbit = orbit_of(other, found_from(other, -1, 1).front());
    ASSERT_TRUE(orbit.has_value());
    AttractorTable table;
    table.add(oscillator, found, std::move(*orbit));
    const CellResult full = testing::solve(oscillator, -1, 0.5);
    ASSERT_EQ(full.regime, Regime::periodic);
    const CellResult result = solve_knowing(table, oscillator, -1, 0.5);
    EXPECT_TRUE(same_orbit(result, full));
    EXPECT_NE(result.peak_force, 12345);
}

}  // namespace
}  // namespace peterka::regime
