// The largest force within one stretch of contact.
//
// The force jumps to chi v at first touch; later maxima are the zeros at which its slope falls through zero.
// They are visited one after another only as long as what is left of the transient could still exceed the
// largest one seen.
#pragma once

#include <algorithm>

#include "trajectory/first_crossing.hpp"

namespace peterka::trajectory {

template <class Real>
class PeakForce {
  public:
    PeakForce(const motion::Signal<Real>& force, const motion::LinearMotion<Real>& contact)
        : force_(force, contact),
          rise_(force_.slope_signal(), contact),
          fall_(-force_.slope_signal(), contact) {}

    // Largest force of a contact leg up to the moment `end`, or `largest` where nothing exceeds it.
    [[nodiscard]] Real over(const Leg<Real>& leg, const Moment<Real>& end, Real largest) const {
        Moment<Real> m = leg.start();
        largest = std::max(largest, force_.value(m));
        bool rising = force_.slope(m) > 0;
        while (force_.rest() + force_.swing() + force_.transient(m) > largest || leg.motion().resonant()) {
            const auto extremum = first_crossing(leg, rising ? fall_ : rise_, m, end.time);
            if (extremum.outcome != Search<Real>::Outcome::crossing) break;
            m = extremum.moment;
            largest = std::max(largest, force_.value(m));
            rising = !rising;
        }
        return std::max(largest, force_.value(end));
    }

  private:
    Probe<Real> force_;
    Probe<Real> rise_;
    Probe<Real> fall_;
};

}  // namespace peterka::trajectory
