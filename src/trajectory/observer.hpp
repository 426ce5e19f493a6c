// Observes the cycles of a motion: each of its smooth stretches, with the engine's own states at any time, and
// each impact.
//
// An engine notifies its observer, if the recorder has one, of stretches in their order. Between two of them
// lies at most a jump of the force or a small kick, on a rigid stop a jump of the velocity.
#pragma once

#include <cstdint>
#include <functional>

#include "trajectory/cycle.hpp"

namespace peterka::trajectory {

// The record of an impact once it is over, in the units of the recorder.
template <class Real>
struct ImpactRecord {
    Real peak_force = 0;  // NaN on a rigid stop
    Real impulse = 0;
    Real contact_time = 0;  // for which the stop presses
    Real work = 0;          // taken from the hammer
};

template <class Real>
class Observer {
  public:
    using StateAt = std::function<State<Real>(Real)>;  // (delta, delta') at a time since the stretch began

    Observer() = default;
    Observer(const Observer&) = delete;
    Observer& operator=(const Observer&) = delete;
    virtual ~Observer() = default;

    // From a time tau of the cycle on, for a length of time; `state_at` is valid during this call only.
    virtual void stretch(Phase phase, Real from, Real length, const StateAt& state_at) = 0;
    // An impact begins where the last stretch ended, at this delta' > 0.
    virtual void touch(Real speed) = 0;
    // The hammer comes to rest on a rigid stop: its last impacts, as many, which seemed over, and the rest that
    // begins are one, a chatter. `leave` tells its impulse and what it adds in time and work.
    virtual void rest(std::int64_t impacts) = 0;
    // An impact is over: the last one touched, or one that began before this observer was attached.
    virtual void leave(const ImpactRecord<Real>& impact) = 0;
};

}  // namespace peterka::trajectory
