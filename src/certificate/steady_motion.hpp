// The two motions that need no search: the hammer swings without meeting the stop, or never leaves it.
//
// With linear springs each is the steady response of one phase, L u = forcing. With a cubic term r(u) there is
// one periodic motion within rho of that in the largest-value norm, as far as G r(U) <= rho and G s < 1: U is
// the linear response's largest |u| plus rho, s the slope of r up to U, and G = int |h| dt, of the impulse
// response h, the norm of the inverse of L (Banach's fixed point).
//
// It attracts, for of the difference w of two motions within U
//     V = (w' + c w/2)^2 + (K + c^2/4) w^2,   V' <= -(c - s) w'^2 - (c K - s (1 + c)) w^2,
// which falls where c > s and c K > s (1 + c).
#pragma once

#include <optional>

#include "certificate/event_chain.hpp"

namespace peterka::certificate {

struct SteadyMotion {
    Interval force;     // the largest, F/(k A0); 0 in flight
    double margin = 0;  // of stability over one forcing cycle (stability.hpp)
    double room = 0;    // how near its signal comes to 0 at most: delta, or kappa delta + chi delta'
    double reach = 0;   // largest |u|
    double shift = 0;   // from the linear response, |delta| and |delta'|
    double rate_shift = 0;
};

// presses: against the stop, with kappa delta + chi delta' > 0 at all times; else in flight, with delta < 0.
// nothing: it isn't proved that there is such a motion. It attracts where the margin is above 0.
[[nodiscard]] std::optional<SteadyMotion> steady_motion(const Springs<Interval>& springs, bool presses);

// Whether the motion from a state at forcing phase 0 is proved never to leave the phase, and to come to that
// one.
[[nodiscard]] bool keeps_to_phase(const Springs<Interval>& springs, bool presses, const SteadyMotion& motion,
                                  const Vector<Interval>& start);

}  // namespace peterka::certificate
