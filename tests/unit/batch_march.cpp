// Bounds of the displacement along flights, step by step.
#include <gtest/gtest.h>

#include <cmath>

#include "batch/batched_cycle_map.hpp"
#include "batch_cases.hpp"

namespace peterka::testing {
namespace {

// The flight would go on beyond the stop by most of a step; what counts is how far the hammer comes.
TEST(BatchMarch, NoFlightReachesBeyondTheStop) {
    constexpr double gap = 2;
    constexpr double speed = 3;
    const auto rig = cubic_rig(1e-6, 1, gap);
    batch::BatchedCycleMap map(rig, 1, 16, batch::Springs::split);
    map.add(rig.frequency, gap, {-0.1, speed});
    map.advance();
    EXPECT_EQ(map.cycle(0).impacts, 1);
    EXPECT_EQ(map.left_to_twin(), 0);
    EXPECT_GE(map.displacement_bound(0), gap);
    EXPECT_LT(map.displacement_bound(0), gap + 1.1 * speed / std::sqrt(rig.kelvin_voigt().stiffness));
}

}  // namespace
}  // namespace peterka::testing
