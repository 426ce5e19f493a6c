// The last step of a proof: one period of a periodic orbit is recorded, from its points, and the orbit is made
// as precise as rounding allows on the way.
#pragma once

#include "regime/observation.hpp"
#include "regime/orbit_round.hpp"
#include "regime/periodic_orbit.hpp"
#include "regime/stroboscopic_map.hpp"
#include "scene/oscillator.hpp"
#include "support/task.hpp"

namespace peterka::regime {

// What the last round of cycles along an orbit showed.
struct MeasuredOrbit {
    OrbitRound round;
    trajectory::Cycle<double>::Outcome outcome =
        trajectory::Cycle<double>::Outcome::done;  // of the one that failed
};

// Records one period, again for as long as Newton's method still moves the orbit's points. What is open at its
// start counts in full at its end, as in every later period.
Task<MeasuredOrbit> measure_orbit(StroboscopicMap& map, PeriodicOrbit& orbit, Observation& observation);

// About how far the peak force of a measured orbit may be off, relative.
double force_error(const StroboscopicMap& map, const PeriodicOrbit& orbit, const OrbitRound& round,
                   double force);

}  // namespace peterka::regime
