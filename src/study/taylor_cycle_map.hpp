// The stroboscopic map by Taylor series in extended precision: a reference for the engines, independent of
// them.
//
// The equation of motion gives the coefficients of its own solution one after another, to any order (Taylor
// method, e.g. Jorba & Zou 2005). Steps are short compared with the motion; the ends of a phase are bracketed
// by signs on a grid within each step and bisected on the series. Springs of any cubic stiffness in either
// form; the three laws of scene/contact_law.hpp:
//   - Kelvin-Voigt: its phases are those of trajectory/linear_legs.hpp.
//   - Restitution: impacts are followed one by one, until the rest of a chatter would take less time than
//     extended precision resolves; the hammer then sticks while it is pressed (phase contact). The impacts of a
//     completed chatter count as one as far as they lie in this cycle.
//   - Hunt-Crossley: delta^n has no series at delta = 0, so steps shrink towards it, down to a depth below
//     which the force has no effect in extended precision.
// Limits of validity: the computing time follows the fastest rate of the contact, sqrt(kappa) + chi, so
// contacts that last for a cycle at a stiff stop exhaust the steps (solver_failed). Low hops with a restitution
// close to 1 end in too_many_events. There is no Jacobian (NaN) and no pattern.
#pragma once

#include "trajectory/cycle.hpp"

namespace peterka::study {

using scene::Oscillator;
using scene::State;
using trajectory::Cycle;
using trajectory::MeasuredCycle;
using trajectory::Phase;

class TaylorCycleMap {
  public:
    using Real = long double;

    explicit TaylorCycleMap(const Oscillator<Real>& oscillator) : oscillator_(oscillator) {}

    [[nodiscard]] const Oscillator<Real>& oscillator() const { return oscillator_; }

    // One cycle from the state x at forcing phase 0.
    [[nodiscard]] MeasuredCycle<Real> operator()(const State<Real>& x) const;

  private:
    Oscillator<Real> oscillator_;
};

}  // namespace peterka::study
