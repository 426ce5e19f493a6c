// Watches the cycles of a motion pass: each of its smooth stretches with the engine's own states at any time,
// and each impact.
//
// An engine tells its observer, where a recorder brings one, of stretches in their order. At most a jump of the
// force or a small kick lies between two of them, on a rigid stop a jump of the velocity.
#pragma once

#include <functional>

#include "trajectory/cycle.hpp"

namespace peterka::trajectory {

// What is known of an impact once it is over, in the units of the recorder.
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

    // From a time tau of the cycle on, for a length of time; `state_at` is good for this call only.
    virtual void stretch(Phase phase, Real from, Real length, const StateAt& state_at) = 0;
    // An impact begins where the last stretch ended, at this delta' > 0.
    virtual void touch(Real speed) = 0;
    // An impact is over: the one touched last, or one that began before this observer came.
    virtual void leave(const ImpactRecord<Real>& impact) = 0;
};

}  // namespace peterka::trajectory
