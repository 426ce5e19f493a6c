// An impact on a rigid stop as an event of a cycle: state, Jacobian, pattern and record, for every engine.
//
// Impacts within one stretch of pressing form a chain. A chain that ends in rest on the stop is a completed
// chatter: one impact, one token of the pattern instead of many, and a state that no longer depends on the
// start (Jacobian 0). The pattern's chain restarts with each cycle, as a cycle is a map; the recorder's chain
// continues across cycles.
#pragma once

#include <limits>
#include <optional>

#include "trajectory/cycle.hpp"
#include "trajectory/recorder.hpp"
#include "trajectory/rigid_stop.hpp"

namespace peterka::trajectory {

// The impacts of the present stretch of pressing, as far as they lie in this cycle.
template <class Real>
struct Chain {
    EventPattern before = 0;  // the cycle's pattern when it began
    Real until = 0;           // the forcing's phase at which the stretch is over
};

// At the start of a cycle: phase 0 may lie within a stretch of pressing, and so within a chain of the recorder.
template <class Real>
Chain<Real> chain_at_start(const RigidStop<Real>& stop, EventPattern pattern) {
    return {pattern, stop.presses(0) ? stop.ahead_to_release(0) : Real(0)};
}

// The stretch is over: a chain that didn't end in rest was no chatter.
template <class Real>
void end_chain_before(Real theta, const Chain<Real>& chain, Recorder<Real>* recorder) {
    if (recorder != nullptr && theta >= chain.until) recorder->break_chain();
}

inline constexpr EventPattern impact_event = pattern_of(Phase::contact);
inline constexpr EventPattern chatter_event = impact_event + 2;  // a completed one

// Reverses the velocity of a hammer that arrives at the stop at the phase theta. A returned value is the time
// from now to rest on the stop: the hammer's state is at rest already, and it sticks from then on. Otherwise it
// flies.
template <class Real>
std::optional<Real> strike(const RigidStop<Real>& stop, Real theta, Cycle<Real>& cycle, Chain<Real>& chain,
                           Recorder<Real>* recorder) {
    const Real speed = cycle.end[1];
    const Real r = stop.restitution();
    const bool pressed = stop.presses(theta) && r < 1;
    end_chain_before(theta, chain, recorder);
    if (theta >= chain.until) chain = {cycle.pattern, pressed ? theta + stop.ahead_to_release(theta) : theta};
    if (recorder != nullptr) recorder->strike({theta, speed}, r, pressed);
    ++cycle.impacts;
    cycle.touched = true;
    cycle.end = {0, -r * speed};
    cycle.jacobian = (stop.saltation(theta, speed) * cycle.jacobian).eval();
    cycle.pattern = append(cycle.pattern, impact_event);

    const auto rest = pressed ? stop.time_to_rest(theta, r * speed) : std::nullopt;
    if (!rest) return std::nullopt;
    if (recorder != nullptr) {
        // the remaining speed is lost in the impacts still to come, whose impulses balance it and a
        recorder->stick(r > 0);
        const Real impulse = stop.impulse(theta, theta + stop.frequency() * *rest) - r * speed;
        recorder->press({.impulse = impulse, .work = r * r * speed * speed / 2});
    }
    cycle.end = {0, 0};
    cycle.jacobian.setZero();
    cycle.pattern = append(chain.before, chatter_event);
    chain.until = theta;
    return rest;
}

// Adds the sticking from one phase to a later one, or to an earlier one to correct for a time of rest that lies
// beyond the end of the cycle.
template <class Real>
void record_sticking(const RigidStop<Real>& stop, Real from, Real to, Recorder<Real>& recorder) {
    if (to > from) recorder.force(stop.largest(from, to));
    recorder.press({.impulse = stop.impulse(from, to), .time = (to - from) / stop.frequency()});
}

}  // namespace peterka::trajectory
