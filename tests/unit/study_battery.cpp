// The extreme scenes of the stability study.
#include "study/battery.hpp"

#include <gtest/gtest.h>

#include "rig.hpp"

namespace peterka::study {
namespace {

TEST(Battery, PlacesGapsByTheAmplitudeWithoutAStop) {
    int placed = 0;
    for (const BatteryScene& scene : battery()) {
        if (!scene.gap_over_grazing) continue;
        ++placed;
        const scene::Cell cell = cell_of(scene, testing::job_170mm(0));
        const double share = cell.oscillator.gap / testing::free_amplitude(cell.oscillator);
        EXPECT_NEAR(share, *scene.gap_over_grazing, 1e-15) << scene.name;
    }
    EXPECT_GE(placed, 4);
}

}  // namespace
}  // namespace peterka::study
