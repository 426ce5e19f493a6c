// Enclosure of a quantity whose sign decides events, at a moment of a leg.
#pragma once

#include "certificate/bends.hpp"
#include "certificate/event_chain.hpp"

namespace peterka::certificate {

// Events occur where these rise through 0.
enum class Signal {
    penetration,  // kappa delta + chi delta', which a flight beyond the surface must keep below 0
    force,        // the negative force, while the stop presses
    pull,         // the same with the other sign, while the stop presses
};

struct Watched {
    Interval value;
    Interval slope;
};

inline Watched watch(const Springs<Interval>& springs, const Phase<Interval>& phase, Signal signal,
                     const Moment<Interval>& moment) {
    const Vector<Interval>& state = moment.state;
    if (signal == Signal::penetration) return {state.position, state.velocity};
    const Interval force = springs.force(state);
    const Interval slope = springs.force({state.velocity, phase.acceleration(state, moment.angle.sine)});
    return signal == Signal::force ? Watched{force, slope} : Watched{-force, -slope};
}

// A bound of the signal's second derivative.
inline double bend_of(const Springs<Interval>& springs, Signal signal, const Bends& bends) {
    return signal == Signal::penetration ? bends.acceleration : bends.of_force(springs.rig);
}

}  // namespace peterka::certificate
