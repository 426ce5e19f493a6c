// The motion without a stop and without a cubic spring: steady oscillation and transient.
#pragma once

#include <cmath>

#include "motion/linear_motion.hpp"
#include "motion/signal.hpp"
#include "trajectory/cycle.hpp"

namespace peterka::trajectory {

// State of the steady motion at forcing phase 0.
template <class Real>
State<Real> steady_at_phase_0(const motion::LinearMotion<Real>& motion) {
    State<Real> x = motion.steady(0, 1);
    x[0] += motion.rest();
    return x;
}

// Bound on the part of a signal that still depends on the start at phase 0, now and later.
template <class Real>
Real decaying_part(const motion::LinearMotion<Real>& motion, const motion::Probe<Real>& probe,
                   const State<Real>& x) {
    return probe.transient(x - steady_at_phase_0(motion));
}

template <class Real>
class FreeFlight {
  public:
    explicit FreeFlight(const Oscillator<Real>& oscillator)
        : oscillator_(oscillator),
          flight_(motion::flight_equation(oscillator)),
          touch_({.position = 1}, flight_) {}

    // Whether the steady motion doesn't reach the stop.
    [[nodiscard]] bool may_last() const { return touch_.rest() + touch_.swing() < 0; }
    // Whether the decaying transient can no longer lift the hammer to the stop: it never impacts again.
    [[nodiscard]] bool lasts(const State<Real>& x) const {
        if (!may_last() || phase_of(oscillator_, x) != Phase::flight) return false;
        const Real room = -(touch_.rest() + touch_.swing());
        const State<Real> decaying = x - steady();
        // the bound is no less than the present transient, which rejects most states without a square root
        return std::abs(decaying[0]) < room && touch_.transient(decaying) < room;
    }
    [[nodiscard]] bool decays() const { return oscillator_.damping_ratio > 0; }

    // Largest |u| of the steady motion (infinite at undamped resonance), and of the motion from the state x on.
    [[nodiscard]] Real amplitude() const { return touch_.swing(); }
    [[nodiscard]] Real largest_displacement(const State<Real>& x) const {
        return amplitude() + decaying_part(flight_, touch_, x);
    }
    [[nodiscard]] State<Real> steady() const { return steady_at_phase_0(flight_); }
    [[nodiscard]] Jacobian<Real> jacobian() const {
        return flight_.flow(oscillator_.period());
    }  // of one cycle

  private:
    Oscillator<Real> oscillator_;
    motion::LinearMotion<Real> flight_;
    motion::Probe<Real> touch_;
};

}  // namespace peterka::trajectory
