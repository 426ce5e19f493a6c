// The limit of an infinitely stiff stop: the impact speed of the z = 1/1 orbit as kappa grows.
//
// An impact on a spring and a dashpot returns the fraction r = exp(-2 zeta_i phi/sqrt(1 - zeta_i^2)) of the
// speed, phi = arccos(zeta_i), and takes a time proportional to kappa^-1/2; so the speed differs from that of a
// rigid stop with this r by a term in kappa^-1/2.
#pragma once

#include <cstdint>

#include "scene/oscillator.hpp"

namespace peterka::study {

struct RigidLimit {
    double frequency = 2;  // eta
    double gap = 0.5;
    double damping_ratio = 0.02;
    double contact_damping_ratio = 0.2;  // zeta_i

    [[nodiscard]] double restitution() const;
    // Impact speed of the z = 1/1 orbit on the rigid stop.
    [[nodiscard]] double rigid_speed() const;
    // The same on a stop of this stiffness, by the exact engine; NaN if it finds no such orbit.
    [[nodiscard]] double compliant_speed(double stiffness) const;
};

// Stiffnesses kappa, each ten times the previous one.
inline constexpr std::int64_t rigid_limit_rungs = 11;
[[nodiscard]] double rung_stiffness(std::int64_t rung);

}  // namespace peterka::study
