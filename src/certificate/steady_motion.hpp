// The two motions that need no search: the hammer never meets the stop, or never leaves it.
//
// With linear springs each is the steady response of one phase, L u = forcing. With a cubic term r(u) there is
// one periodic motion within rho of it in the maximum norm if G r(U) <= rho and G s < 1: U is the linear
// response's largest
// u| plus rho, s the slope of r up to U, and G = int |h| dt, with the impulse response h, the norm of the
// inverse of L (Banach's fixed-point theorem).
//
// It attracts, since for the difference w of two motions within U
//     V = (w' + c w/2)^2 + (K + c^2/4) w^2,   V' <= -(c - s) w'^2 - (c K - s (1 + c)) w^2,
// which decreases where c > s and c K > s (1 + c).
#pragma once

#include <optional>

#include "certificate/event_chain.hpp"

namespace peterka::certificate {

struct SteadyMotion {
    Interval force;     // the largest force, F/(k A0); 0 in flight
    double margin = 0;  // of stability over one forcing cycle (stability.hpp)
    double room = 0;    // lower bound of the distance from 0 of its signal: delta, kappa delta + chi delta', or
                        // the acceleration that presses it against a rigid stop
    double reach = 0;   // largest |u|
    double shift = 0;   // bounds of the distance from the linear response, in delta and delta'
    double rate_shift = 0;
};

// presses: against the stop, with kappa delta + chi delta' > 0 at all times; otherwise in flight, with delta <
// 0. nothing: existence is not proved. The motion attracts if the margin is positive.
[[nodiscard]] std::optional<SteadyMotion> steady_motion(const Springs<Interval>& springs, bool presses);

// Whether a motion is proved never to leave the phase after an event, or after its start if there is none, and
// to converge to the steady motion.
[[nodiscard]] bool keeps_to_phase(const Springs<Interval>& springs, bool presses, const SteadyMotion& motion,
                                  const Leg<Interval>& leg, std::optional<EventKind> from);

}  // namespace peterka::certificate
