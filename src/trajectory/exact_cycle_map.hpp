// The stroboscopic map of the hammer: one forcing cycle, from phase 0 to phase 0, in closed form.
//
// All legs of a cycle are linear: see linear_legs.hpp for a spring-dashpot stop, rigid_legs.hpp for a rigid
// one. The cubic part of the springs is omitted.
#pragma once

#include "scene/oscillator.hpp"
#include "trajectory/cycle.hpp"
#include "trajectory/linear_legs.hpp"
#include "trajectory/rigid_legs.hpp"

namespace peterka::trajectory {

template <class Real, class Legs = LinearLegs<Real>>
class ExactCycleMap {
  public:
    explicit ExactCycleMap(const Oscillator<Real>& oscillator) : oscillator_(oscillator), legs_(oscillator) {}

    [[nodiscard]] const Oscillator<Real>& oscillator() const { return oscillator_; }

    // One cycle from the state x at forcing phase 0; a recorder collects the events on the way.
    [[nodiscard]] Cycle<Real> operator()(const State<Real>& x, Recorder<Real>* recorder = nullptr) const {
        Journey<Real> journey = legs_.depart(x);
        if (legs_.run(journey, oscillator_.period(), recorder)) legs_.arrive(journey, recorder);
        return journey.cycle;
    }

    // Part of a cycle: from the state x at tau = from to a later tau = to.
    [[nodiscard]] Cycle<Real> part(const State<Real>& x, Real from, Real to) const {
        Journey<Real> journey = legs_.depart(x, from);
        if (legs_.run(journey, to, nullptr)) legs_.arrive(journey, nullptr);
        return journey.cycle;
    }

  private:
    Oscillator<Real> oscillator_;
    Legs legs_;
};

template <class Real>
using RigidExactMap = ExactCycleMap<Real, RigidLegs<Real>>;

}  // namespace peterka::trajectory
