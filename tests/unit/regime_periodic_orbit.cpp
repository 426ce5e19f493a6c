// Newton's method on the stroboscopic map.
#include "regime/periodic_orbit.hpp"

#include <gtest/gtest.h>

#include "regime/scalar_engine.hpp"
#include "rig.hpp"

namespace peterka::regime {
namespace {

// From the stable 1/1 at 2.5 on, each orbit the guess for the next one.
struct Followed {
    std::optional<PeriodicOrbit> orbit;
    std::int64_t cycles = 0;  // spent on the last one
};
Followed follow_one_a_cycle(double last_frequency, double most_stretch) {
    constexpr double first_frequency = 2.5;
    constexpr int steps = 10;
    auto scene = testing::paper_rig(testing::beam_170mm, first_frequency, 0);
    const CellResult stable = find_steady_state(scene, testing::start_at(scene), {});
    EXPECT_EQ(stable.regime, Regime::periodic);
    scene::State<double> point(stable.orbit_displacement - scene.gap, stable.orbit_velocity);
    Followed followed;
    for (int step = 1; step <= steps; ++step) {
        scene.frequency = first_frequency + (last_frequency - first_frequency) * step / steps;
        const bool last = step == steps;
        CycleDesk desk;
        StroboscopicMap map(scene, {}, desk);
        followed.orbit = last ? complete(find_orbit(map, map.scaled(point), 1, most_stretch), desk)
                              : complete(find_orbit(map, map.scaled(point), 1), desk);
        followed.cycles = map.cycles_spent();
        if (!followed.orbit) break;
        point = map.unscaled(followed.orbit->point);
    }
    return followed;
}

TEST(FindOrbit, ReachesUnstableOrbitsToo) {
    const auto [orbit, cycles] = follow_one_a_cycle(3.1, std::numeric_limits<double>::infinity());
    ASSERT_TRUE(orbit);
    EXPECT_GT(orbit->multiplier, 1.5);  // the period doubled at 2.659
    EXPECT_FALSE(is_stable(*orbit));
    EXPECT_GT(cycles, 1);
}

TEST(FindOrbit, GivesUpAfterTheFirstPassWhereThatStretches) {
    const auto [orbit, cycles] = follow_one_a_cycle(3.1, 1.2);
    EXPECT_FALSE(orbit);
    EXPECT_EQ(cycles, 1);
}

TEST(FindOrbit, GoesOnWhereItContracts) {
    const auto [orbit, cycles] = follow_one_a_cycle(2.6, 1.2);
    ASSERT_TRUE(orbit);
    EXPECT_TRUE(is_stable(*orbit));
}

}  // namespace
}  // namespace peterka::regime
