// How strongly cart and hammer are disturbed at random, in the units of the core.
#pragma once

#include <cmath>
#include <numbers>

#include "job/job.hpp"
#include "scene/scales.hpp"

namespace peterka::noise {

struct Disturbance {
    double speed = 0;  // standard deviation of the velocity that white noise adds per sqrt(tau), in A0 omega
    double amplitude = 0;  // of the cart's amplitude in each cycle, relative
    double frequency = 0;  // of the frequency of each cycle, relative
};

// A white acceleration of one-sided spectral density S changes the velocity in a time t by a random amount of
// variance S t/2.
[[nodiscard]] inline Disturbance disturbance_of(const job::Noise& noise, const scene::Scales& scales) {
    const double speed = scales.length_m * scales.frequency_rad_per_s;
    return {.speed = noise.acceleration_m_s2_per_sqrt_hz / std::numbers::sqrt2 /
                     std::sqrt(scales.frequency_rad_per_s) / speed,
            .amplitude = noise.amplitude_relative,
            .frequency = noise.frequency_relative};
}

}  // namespace peterka::noise
