// Motions of the paper's rig of 170 mm that tests of src/noise share.
#pragma once

#include "noise/home.hpp"
#include "rig.hpp"

namespace peterka::noise::testing {

// A settled motion at phase 0, relative to the stop.
struct Settled {
    scene::Oscillator<double> oscillator;
    scene::State<double> point;
    int period = 1;
};

inline Settled settled(const scene::Oscillator<double>& oscillator, double displacement, double velocity) {
    const regime::CellResult result = peterka::testing::solve(oscillator, displacement, velocity);
    return {oscillator,
            {result.orbit_displacement - oscillator.gap, result.orbit_velocity},
            std::max(result.period, 1)};
}

// Without impacts, in closed form.
inline Settled free_motion(double frequency, double gap) {
    const auto oscillator = peterka::testing::paper_rig(peterka::testing::beam_170mm, frequency, gap);
    const double square = frequency * frequency;
    const double stiff = 1 - square;
    const double damped = 2 * oscillator.damping_ratio * frequency;
    const double size = square / (stiff * stiff + damped * damped);
    return {oscillator, {-size * damped - gap, size * stiff * frequency}, 1};
}

// z = 1/3, whose basin is narrow.
inline Settled one_in_three() {
    const auto oscillator = peterka::testing::paper_rig(peterka::testing::beam_170mm, 0.9, 3);
    DisturbedMap map(oscillator, {}, {});
    scene::State<double> state(-2.0288 - 3, 2.9446);
    for (int n = 0; n < 300; ++n) state = *map.at_next_phase_0({state});
    return {oscillator, state, 3};
}

inline Disturbance white(double speed) {
    return {.speed = speed};
}

}  // namespace peterka::noise::testing
