#include "certificate/event_chain.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace peterka::certificate {
namespace {

// On the surface without force, where the coordinate's direction has a 1 and nothing larger.
TEST(Springs, AReleaseIsToldByItsVelocityUnlessTheDashpotIsLarger) {
    struct Stop {
        double stiffness;
        double damping;
        bool by_velocity;
    };
    for (const Stop& stop : {Stop{4, 2, true}, Stop{4, 4, true}, Stop{2, 4, false}}) {
        const Springs<double> springs(
            RigOf<double>{.stiffness = stop.stiffness, .damping = stop.damping, .frequency = 1});
        for (const EventKind kind : {EventKind::release, EventKind::resume}) {
            const Vector<double> d = springs.surface(kind);
            EXPECT_EQ(springs.force(d), 0);
            EXPECT_EQ(std::max(std::abs(d.position), std::abs(d.velocity)), 1);
            const Vector<double> state{3 * stop.damping, -3 * stop.stiffness};
            EXPECT_EQ(springs.along(kind, state), stop.by_velocity ? state.velocity : state.position);
        }
    }
}

}  // namespace
}  // namespace peterka::certificate
