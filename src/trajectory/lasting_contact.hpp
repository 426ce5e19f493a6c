// Permanent contacts without a cubic spring, for each law that has a closed form for them.
#pragma once

#include <cmath>
#include <numbers>

#include "motion/linear_motion.hpp"
#include "motion/signal.hpp"
#include "trajectory/cycle.hpp"
#include "trajectory/free_flight.hpp"
#include "trajectory/rigid_stop.hpp"

namespace peterka::trajectory {

// On a spring-dashpot stop: a steady oscillation under load.
template <class Real>
class LinearContact {
  public:
    explicit LinearContact(const Oscillator<Real>& oscillator)
        : oscillator_(oscillator),
          contact_(motion::contact_equation(oscillator)),
          release_({.position = -oscillator.kelvin_voigt().stiffness,
                    .velocity = -oscillator.kelvin_voigt().damping},
                   contact_),
          depth_({.position = 1}, contact_) {}

    // Whether the stop presses all the time in the steady motion.
    [[nodiscard]] bool may_last() const { return release_.rest() + release_.swing() < 0; }
    // Whether the decaying transient can no longer make the force vanish: the stop presses for ever.
    [[nodiscard]] bool lasts(const State<Real>& x) const {
        return may_last() && phase_of(oscillator_, x) == Phase::contact &&
               release_.rest() + release_.swing() + decaying_part(contact_, release_, x) < 0;
    }
    [[nodiscard]] bool decays() const {
        return oscillator_.damping_ratio > 0 || oscillator_.kelvin_voigt().damping > 0;
    }

    // Largest force once the transient has decayed, and from the state x on.
    [[nodiscard]] Real steady_force() const { return release_.swing() - release_.rest(); }
    [[nodiscard]] Real largest_force(const State<Real>& x) const {
        return steady_force() + decaying_part(contact_, release_, x);
    }
    [[nodiscard]] Real largest_displacement(const State<Real>& x) const {
        return std::abs(depth_.rest() + oscillator_.gap) + depth_.swing() + decaying_part(contact_, depth_, x);
    }
    [[nodiscard]] State<Real> steady() const { return steady_at_phase_0(contact_); }
    [[nodiscard]] Jacobian<Real> jacobian() const {
        return contact_.flow(oscillator_.period());
    }  // of one cycle

  private:
    Oscillator<Real> oscillator_;
    motion::LinearMotion<Real> contact_;
    motion::Probe<Real> release_;
    motion::Probe<Real> depth_;
};

// On a rigid stop: rest.
template <class Real>
class RigidContact {
  public:
    explicit RigidContact(const Oscillator<Real>& oscillator) : oscillator_(oscillator), stop_(oscillator) {}

    [[nodiscard]] bool may_last() const { return stop_.always_presses(); }
    [[nodiscard]] bool lasts(const State<Real>& x) const {
        return may_last() && phase_of(oscillator_, x) == Phase::contact;
    }
    [[nodiscard]] bool decays() const { return true; }  // nothing is left to decay
    [[nodiscard]] Real steady_force() const { return stop_.largest(0, 2 * std::numbers::pi_v<Real>); }
    [[nodiscard]] Real largest_force(const State<Real>& /*x*/) const { return steady_force(); }
    [[nodiscard]] Real largest_displacement(const State<Real>& /*x*/) const {
        return std::abs(oscillator_.gap);
    }
    [[nodiscard]] State<Real> steady() const { return State<Real>::Zero(); }
    [[nodiscard]] Jacobian<Real> jacobian() const { return Jacobian<Real>::Zero(); }

  private:
    Oscillator<Real> oscillator_;
    RigidStop<Real> stop_;
};

}  // namespace peterka::trajectory
