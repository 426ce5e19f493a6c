// The largest value of a signal within a leg: of the force within a contact, or of the displacement.
//
// The force jumps to chi v at first touch; later maxima are the zeros at which the signal's slope falls through
// zero. They are visited one after another only as long as the remaining transient could still exceed the
// largest value seen.
#pragma once

#include <algorithm>

#include "trajectory/first_crossing.hpp"

namespace peterka::trajectory {

template <class Real>
class LargestValue {
  public:
    LargestValue(const motion::Signal<Real>& signal, const motion::LinearMotion<Real>& motion)
        : signal_(signal, motion),
          rise_(signal_.slope_signal(), motion),
          fall_(-signal_.slope_signal(), motion) {}

    [[nodiscard]] const Probe<Real>& signal() const { return signal_; }

    // Largest value in a leg between two moments, or `largest` if nothing exceeds it.
    [[nodiscard]] Real over(const Leg<Real>& leg, const Moment<Real>& from, const Moment<Real>& end,
                            Real largest) const {
        Moment<Real> m = from;
        largest = std::max(largest, signal_.value(m));
        bool rising = signal_.slope(m) > 0;
        while (signal_.rest() + signal_.swing() + signal_.transient(m.homogeneous) > largest ||
               leg.motion().resonant()) {
            const auto extremum = first_crossing(leg, rising ? fall_ : rise_, m, end.time);
            if (extremum.ending != Crossing<Real>::Ending::crossing) break;
            m = extremum.moment;
            largest = std::max(largest, signal_.value(m));
            rising = !rising;
        }
        return std::max(largest, signal_.value(end));
    }

  private:
    Probe<Real> signal_;
    Probe<Real> rise_;
    Probe<Real> fall_;
};

}  // namespace peterka::trajectory
