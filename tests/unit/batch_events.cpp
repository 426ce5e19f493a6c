// What the kernel tells of single impacts.
#include <gtest/gtest.h>

#include <cmath>

#include "batch/batched_cycle_map.hpp"

namespace peterka::testing {
namespace {

// By its energy the hammer comes no deeper into this soft, strongly damped stop than v/w and what the forcing
// adds, half as far as it swings in flight; the amplitude of its damped oscillation, v/rate, is three times as
// large.
TEST(BatchEvents, AnImpactGoesNoFurtherThanItsEnergy) {
    constexpr double stiffness = 3;
    constexpr double damping_ratio = 0.94;
    const double frequency_in_contact = std::sqrt(1 + stiffness);
    const scene::Oscillator<double> rig{
        .damping_ratio = 1e-3,
        .contact = scene::KelvinVoigt<double>{stiffness, 2 * damping_ratio * frequency_in_contact},
        .frequency = 0.05};
    batch::BatchedCycleMap map(rig, 1, batch::BatchedCycleMap::steps_for(rig.frequency));
    map.add(rig.frequency, 0, {-0.01, 1});
    map.advance();
    EXPECT_GT(map.cycle(0).impacts, 0);
    EXPECT_EQ(map.left_to_twin(), 0);
    EXPECT_LT(map.displacement_bound(0), 1.1);
}

}  // namespace
}  // namespace peterka::testing
