// Where a walk meets the stop, against motions short or simple enough to be known.
#include "certificate/find_chain.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace peterka::certificate {
namespace {

RigOf<double> rig_with_stop(double stiffness, double damping) {
    return {.damping_ratio = 0.01,
            .stiffness = stiffness,
            .damping = damping,
            .frequency = 2,
            .gap = 0.5,
            .period = std::numbers::pi};
}

// So shortly before the stop, a flight is straight.
TEST(Walk, MeetsTheStopToWithinRounding) {
    const Springs<double> springs(rig_with_stop(100, 1));
    for (const double before : {1.25e-13, 1.45e-13, 1e-12, 1e-9}) {
        Walk walk(springs, 0, {-3 * before, 3});
        Event event;
        ASSERT_EQ(walk.go_on(1, event), Walk::End::event);
        EXPECT_EQ(event.kind, EventKind::touch);
        EXPECT_NEAR(event.time, before, 1.01e-13);
    }
}

// Beyond the surface, with a velocity at which spring and dashpot cancel: the stop, which never pulls, has no
// part in the motion until the hammer has left and come back.
TEST(Walk, FromWhereTheForceFallsThroughZeroIsAFlight) {
    const Springs<double> springs(rig_with_stop(8, 2));
    const Vector<double> start{0.25, -1};
    ASSERT_EQ(springs.force(start), 0);
    Walk walk(springs, 0, start);
    Event event;
    ASSERT_EQ(walk.go_on(10, event), Walk::End::event);
    EXPECT_EQ(event.kind, EventKind::touch);
    EXPECT_GT(event.time, 0.5);
    const Vector<double> met = Leg<double>(springs.phase(false), 0, start).at(event.time).state;
    EXPECT_NEAR(met.position, 0, 1e-12);
    EXPECT_GT(met.velocity, 0);
}

}  // namespace
}  // namespace peterka::certificate
