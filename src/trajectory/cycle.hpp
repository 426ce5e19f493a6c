// What every engine returns for one forcing cycle, and the parts of the model that don't depend on the engine.
#pragma once

#include <cstdint>
#include <limits>
#include <variant>

#include "scene/oscillator.hpp"
#include "trajectory/contact_force.hpp"
#include "trajectory/rigid_stop.hpp"

namespace peterka::trajectory {

using scene::Jacobian;
using scene::Oscillator;
using scene::State;

enum class Phase : std::uint8_t { flight, contact, unloaded };

// The phase at the start of a cycle is a function of the state alone, so that a cycle is a map. On a rigid stop
// the hammer is in contact where it is at rest and pressed; an impact is not a phase.
template <class Real>
Phase phase_of(const Oscillator<Real>& oscillator, const State<Real>& x) {
    if (scene::is_rigid(oscillator.contact)) {
        const bool rests = x[0] == 0 && x[1] == 0;
        return rests && RigidStop<Real>(oscillator).presses(0) ? Phase::contact : Phase::flight;
    }
    if (x[0] < 0 || (x[0] == 0 && x[1] <= 0)) return Phase::flight;
    return grip(oscillator, x).value > 0 || x[0] == 0 ? Phase::contact : Phase::unloaded;
}

// Order and kind of the contacts in a cycle; two cycles with equal patterns lie on one smooth branch of the
// map. A hash of the sequence (like FNV-1a): unequal sequences are taken for equal with a probability of 2^-64.
using EventPattern = std::uint64_t;

constexpr EventPattern append(EventPattern pattern, EventPattern next) {
    return pattern == 0 ? next : (pattern ^ next) * 0x100000001b3ULL;
}

// A phase as part of a pattern. Where the hammer leaves delta > 0 while unloaded makes no difference to the
// map, so flight is only appended at the start of a cycle.
constexpr EventPattern pattern_of(Phase phase) {
    return static_cast<EventPattern>(phase) + 1;
}

template <class Real>
struct Cycle {
    enum class Outcome { done, too_many_events, not_finite, solver_failed, inside_stop };
    Outcome outcome = Outcome::done;
    State<Real> end = State<Real>::Zero();
    Jacobian<Real> jacobian = Jacobian<Real>::Identity();  // derivative of the end by the start
    EventPattern pattern = 0;
    int impacts = 0;  // upward crossings of delta = 0, each one of a chatter included
    Real last_touch = std::numeric_limits<Real>::quiet_NaN();  // tau at the last impact, from the cycle's start
    bool touched = false;                                      // the stop pressed at some time
    bool separated = false;                                    // delta < 0 at some time
};

// A cycle of a map that always measures. A completed chatter counts as one impact.
template <class Real>
struct MeasuredCycle : Cycle<Real> {
    Real peak_force = 0;            // largest F/(k A0)
    Real impact_speed = 0;          // largest delta' at first touch
    Real largest_displacement = 0;  // of |u|, at the points sampled
};

}  // namespace peterka::trajectory
