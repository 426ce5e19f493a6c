// The lower bound of critical kicks, against plain simulations.
#include "attractors/safe_kicks.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "regime/same_attractor.hpp"
#include "regime/stroboscopic_map.hpp"
#include "rig.hpp"

namespace peterka::attractors {
namespace {

using regime::FoundAttractor;

struct Settled {
    scene::Oscillator<double> oscillator;
    FoundAttractor found;
    regime::AttractorTable known;
};

Settled settled_at(double frequency, double gap) {
    Settled settled{testing::paper_rig(testing::beam_170mm, frequency, gap), {}, {}};
    settled.oscillator.cubic = 0;
    settled.found = {0, {}, testing::solve(settled.oscillator)};
    EXPECT_EQ(settled.found.result.regime, regime::Regime::periodic);
    regime::CycleBroker broker;
    const regime::Places places =
        complete(regime::find_places(broker, settled.oscillator, settled.found, 1), broker);
    settled.known.add(settled.oscillator, settled.found, places.neighbourhoods);
    return settled;
}

std::optional<double> safe(const Settled& settled, double most) {
    KickedOrbit orbit(settled.oscillator, settled.found);
    return largest_safe_kick(orbit, settled.known, settled.oscillator, settled.found, most);
}

// At all phases, contact included, including those not tried for the bound.
void expect_all_come_back(const Settled& settled, double size) {
    KickedOrbit orbit(settled.oscillator, settled.found);
    for (int n = 0; n < 500; ++n) {
        const double phase = orbit.period() * std::fmod(n * 0.7548776662466927, 1.0);
        const double change = size * (2 * std::fmod(n * 0.5698402909980532, 1.0) - 1);
        const auto start = orbit.after({phase, change});
        ASSERT_TRUE(start.done());
        const auto end = regime::find_steady_state(settled.oscillator, start.state, {});
        EXPECT_TRUE(regime::same_attractor(settled.found.result, end)) << phase << ' ' << change;
    }
}

TEST(SafeKicks, LeadBackAtAllPhases) {
    for (const auto& [frequency, gap] : {std::pair{2.0, 0.0}, std::pair{2.67, 0.4}, std::pair{3.2, 0.6}}) {
        const Settled settled = settled_at(frequency, gap);
        const auto bound = safe(settled, 4);
        ASSERT_TRUE(bound.has_value()) << frequency;
        EXPECT_GT(*bound, 1e-3) << frequency;
        expect_all_come_back(settled, *bound);
    }
}

// Whether kicks of this size, at the trial phases, end their period in this neighbourhood.
bool land_in(const regime::Neighbourhood& place, const Settled& settled, double size) {
    regime::CycleBroker broker;
    const regime::StroboscopicMap map(settled.oscillator, settled.found.settings, broker);
    KickedOrbit orbit(settled.oscillator, settled.found);
    for (int n = 0; n < 48 * orbit.period(); ++n) {
        for (const double change : {size, -size}) {
            const auto end = orbit.round({n / 48.0, change});
            if (!end || !place.contains(map.scaled(*end))) return false;
        }
    }
    return true;
}

// The same with another point of the orbit as the first.
Settled from_next_point(Settled settled) {
    const auto next = KickedOrbit(settled.oscillator, settled.found).after({1, 0});
    EXPECT_TRUE(next.done());
    settled.found.result.orbit_displacement = next.state[0] + settled.oscillator.gap;
    settled.found.result.orbit_velocity = next.state[1];
    return settled;
}

// Neighbourhoods on all sides of the orbit's point, so that
// each admits fewer kicks of some phases and one direction.
void expect_half_of_what_lands_in_places_of(Settled settled) {
    regime::CycleBroker broker;
    const regime::StroboscopicMap map(settled.oscillator, settled.found.settings, broker);
    const regime::CellResult& orbit = settled.found.result;
    const regime::Point point = map.scaled(
        scene::State<double>(orbit.orbit_displacement - settled.oscillator.gap, orbit.orbit_velocity));
    for (int side = 0; side < 8; ++side) {
        const double angle = std::numbers::pi / 4 * side;
        const regime::Point aside(std::cos(angle), std::sin(angle));
        const regime::Neighbourhood place(point + 0.009 * aside, Eigen::Matrix2d::Identity(), 0.01);
        settled.known = {};
        settled.known.add(settled.oscillator, settled.found, std::vector{place});
        const auto bound = safe(settled, 0.1);
        ASSERT_TRUE(bound.has_value()) << side;
        EXPECT_TRUE(land_in(place, settled, 2 * *bound)) << side;
        EXPECT_FALSE(land_in(place, settled, 2.2 * *bound)) << side;
    }
}

TEST(SafeKicks, AreHalfOfWhatLandsInThePlace) {
    expect_half_of_what_lands_in_places_of(settled_at(2, 0));
    const Settled doubled = settled_at(2.67323, 0);
    EXPECT_EQ(doubled.found.result.period, 2);
    expect_half_of_what_lands_in_places_of(doubled);
    expect_half_of_what_lands_in_places_of(from_next_point(doubled));
}

TEST(SafeKicks, AreOfTheOrbitsOwnPlace) {
    Settled settled = settled_at(2, 0);
    FoundAttractor other = settled.found;
    other.result.orbit_displacement += 1;
    regime::CycleBroker broker;
    const auto places = complete(regime::find_places(broker, settled.oscillator, settled.found, 1), broker);
    settled.known = {};
    settled.known.add(settled.oscillator, other, places.neighbourhoods);
    EXPECT_FALSE(safe(settled, 4).has_value());
}

TEST(SafeKicks, AreNotTriedOnLongOrbits) {
    Settled settled = settled_at(2, 0);
    regime::CycleBroker broker;
    const auto places = complete(regime::find_places(broker, settled.oscillator, settled.found, 1), broker);
    for (const int period : {8, 9}) {  // the same orbit, traversed this many times
        settled.found.result.period = period;
        settled.known = {};
        settled.known.add(settled.oscillator, settled.found, places.neighbourhoods);
        EXPECT_EQ(safe(settled, 4).has_value(), period == 8);
    }
}

TEST(SafeKicks, AreNoMoreThanHalfOfWhatIsTried) {
    const Settled settled = settled_at(2, 0);
    EXPECT_EQ(safe(settled, 1e-3), 0.5e-3);
}

TEST(SafeKicks, AreUnknownWithoutANeighbourhood) {
    Settled settled = settled_at(2, 0);
    settled.known = {};
    EXPECT_FALSE(safe(settled, 4).has_value());
}

}  // namespace
}  // namespace peterka::attractors
