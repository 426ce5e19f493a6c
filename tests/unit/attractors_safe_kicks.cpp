// The lower bound of critical kicks, against plain runs.
#include "attractors/safe_kicks.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "regime/same_attractor.hpp"
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
    regime::CycleDesk desk;
    const regime::Places places =
        complete(regime::find_places(desk, settled.oscillator, settled.found, 1), desk);
    settled.known.add(settled.oscillator, settled.found, places.neighbourhoods);
    return settled;
}

std::optional<double> safe(const Settled& settled, double most) {
    KickedOrbit orbit(settled.oscillator, settled.found);
    return largest_safe_kick(orbit, settled.known, settled.oscillator, settled.found, most);
}

// Of all phases, contact included, where they were not tried when the bound was made.
void expect_all_come_back(const Settled& settled, double size) {
    KickedOrbit orbit(settled.oscillator, settled.found);
    for (int n = 0; n < 500; ++n) {
        const double phase = orbit.period() * std::fmod(n * 0.7548776662466927, 1.0);
        const double change = size * (2 * std::fmod(n * 0.5698402909980532, 1.0) - 1);
        const auto start = orbit.after({phase, change});
        ASSERT_TRUE(start.has_value());
        const auto end = regime::find_steady_state(settled.oscillator, *start, {});
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
