// Forces of contacts made up by hand, against a close look at them.
#include "curves/orbit_check.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace peterka::curves {
namespace {

// A soft stop without a dashpot, on which the hammer oscillates a few times at its own frequency, 5, and that
// of the forcing before it is released.
constexpr PlanePoint place{1.3, -2};
Rig soft_rig() {
    scene::Oscillator<double> oscillator;
    oscillator.damping_ratio = 0.01;
    oscillator.contact = scene::KelvinVoigt<double>{24, 0};
    return Rig(oscillator);
}
OrbitPoint long_contact(double begin) {
    return {{1, {{EventKind::touch, true, begin, 1}, {EventKind::release, false, begin + 8, -1}}}, place};
}

// So it is in any of the forcing's cycles in which the events are counted.
TEST(PeakForce, IsTheLargestOfAllMaximaOfAContact) {
    const PlacedRig rig = soft_rig().at(place);
    for (const std::int64_t cycle : {0, 1, 2000}) {
        const OrbitPoint point = long_contact(0.7 + rig.duration_of(cycle));
        const Event& touch = point.orbit.events[0];
        double largest = 0;
        int maxima = 0;
        double before = 0;
        bool rose = true;
        for (int i = 0; i <= 40'000; ++i) {
            const double time = touch.time + 8 * i / 40'000.0;
            const double force = rig.force(rig.state_in_leg(true, touch.time, rig.departure(touch), time));
            maxima += rose && force < before ? 1 : 0;
            rose = force > before;
            before = force;
            largest = std::max(largest, force);
        }
        EXPECT_GE(maxima, 5);
        EXPECT_NEAR(peak_force(soft_rig(), point), largest, 1e-6 * largest) << cycle;
    }
}

}  // namespace
}  // namespace peterka::curves
