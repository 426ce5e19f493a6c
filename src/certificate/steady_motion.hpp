// The two motions that need no search: the hammer swings without meeting the stop, or never leaves it. Each is
// the steady response of one linear phase, and all motions that keep to the phase come to it (c > 0).
#pragma once

#include <optional>

#include "certificate/event_chain.hpp"

namespace peterka::certificate {

struct SteadyMotion {
    Interval force;     // the largest, F/(k A0); 0 in flight
    double margin = 0;  // of stability over one forcing cycle (stability.hpp)
};

// presses: against the stop, with kappa delta + chi delta' > 0 at all times; else in flight, with delta < 0.
// nothing: it isn't proved that the steady response does that. It attracts where the margin is above 0.
[[nodiscard]] std::optional<SteadyMotion> steady_motion(const Springs<Interval>& springs, bool presses);

// Whether the motion from a state at forcing phase 0 is proved never to leave the phase.
[[nodiscard]] bool keeps_to_phase(const Springs<Interval>& springs, bool presses,
                                  const Vector<Interval>& start);

}  // namespace peterka::certificate
