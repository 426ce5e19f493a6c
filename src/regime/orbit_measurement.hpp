// The last step of a proof: one period of a periodic orbit is recorded, from its points, while the orbit is
// refined as far as rounding allows.
#pragma once

#include "regime/observation.hpp"
#include "regime/orbit_round.hpp"
#include "regime/periodic_orbit.hpp"
#include "regime/stroboscopic_map.hpp"
#include "scene/oscillator.hpp"
#include "support/task.hpp"

namespace peterka::regime {

// The result of the last round of cycles along an orbit.
struct MeasuredOrbit {
    OrbitRound round;
    trajectory::Cycle<double>::Outcome outcome =
        trajectory::Cycle<double>::Outcome::done;  // of the cycle that failed
};

// Records one period, repeatedly while Newton's method still moves the orbit's points. An event open at its
// start counts in full at its end, as in every later period.
Task<MeasuredOrbit> measure_orbit(StroboscopicMap& map, PeriodicOrbit& orbit, Observation& observation);

// Approximate relative error of the peak force of a measured orbit.
double force_error(const StroboscopicMap& map, const PeriodicOrbit& orbit, const OrbitRound& round,
                   double force);

}  // namespace peterka::regime
