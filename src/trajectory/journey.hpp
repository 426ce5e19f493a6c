// A cycle in progress from phase 0 to phase 0, leg by leg.
#pragma once

#include "trajectory/cycle.hpp"
#include "trajectory/rigid_impact.hpp"

namespace peterka::trajectory {

template <class Real>
struct Journey {
    Journey(const Oscillator<Real>& oscillator, const State<Real>& start) : phase(phase_of(oscillator, start)) {
        cycle.end = start;
        cycle.pattern = pattern_of(phase);
    }

    Cycle<Real> cycle;  // up to now
    Phase phase;
    Real time = 0;  // tau since the cycle began
    int events = 0;
    // for a rigid stop
    Chain<Real> chain = {};  // the impacts of the present stretch of pressing
    Real rest_from = 0;      // when the present rest on the stop began, or will after the last of a chatter

    // Ends the journey early.
    bool stop(typename Cycle<Real>::Outcome why) {
        cycle.outcome = why;
        return false;
    }
};

}  // namespace peterka::trajectory
