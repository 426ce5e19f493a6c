// The stroboscopic map of the hammer: one forcing cycle, from phase 0 to phase 0, in closed form.
//
// All legs of a cycle are linear (see linear_legs.hpp); the cubic part of the springs is left out.
#pragma once

#include <cmath>

#include "motion/linear_motion.hpp"
#include "scene/oscillator.hpp"
#include "trajectory/cycle.hpp"
#include "trajectory/linear_legs.hpp"

namespace peterka::trajectory {

template <class Real>
class ExactCycleMap {
  public:
    explicit ExactCycleMap(const Oscillator<Real>& scene)
        : scene_(scene), legs_(scene, motion::flight_equation(scene), motion::contact_equation(scene)) {}

    [[nodiscard]] const Oscillator<Real>& scene() const { return scene_; }

    // One cycle from the state x at forcing phase 0; a recorder gathers what happens on the way.
    [[nodiscard]] Cycle<Real> operator()(const State<Real>& x, Recorder<Real>* recorder = nullptr) const {
        Journey<Real> journey(scene_, x);
        legs_.run(journey, scene_.period(), recorder);
        return journey.cycle;
    }

    // The decaying rest of a free flight can no longer lift the hammer to the stop: it never impacts again.
    [[nodiscard]] bool stays_free(const State<Real>& x) const {
        const Probe<Real>& touch = legs_.touch();
        return phase_of(scene_, x) == Phase::flight &&
               touch.rest() + touch.swing() + decaying(legs_.flight(), touch, x) < 0;
    }

    // The decaying rest of a contact can no longer make the force vanish: it presses for ever.
    [[nodiscard]] bool stays_in_contact(const State<Real>& x) const {
        const Probe<Real>& release = legs_.release();
        return phase_of(scene_, x) == Phase::contact &&
               release.rest() + release.swing() + decaying(legs_.contact(), release, x) < 0;
    }

    // Largest force of a contact that lasts for ever: once its transient is gone, and from the state x on.
    [[nodiscard]] Real steady_contact_force() const { return legs_.release().swing() - legs_.release().rest(); }
    [[nodiscard]] Real largest_contact_force(const State<Real>& x) const {
        return steady_contact_force() + decaying(legs_.contact(), legs_.release(), x);
    }
    // Largest |u| of the steady motion without a stop (infinite at undamped resonance), of the motion without
    // one from the state x on, and of such a contact.
    [[nodiscard]] Real free_amplitude() const { return legs_.touch().swing(); }
    [[nodiscard]] Real largest_free_displacement(const State<Real>& x) const {
        return free_amplitude() + decaying(legs_.flight(), legs_.touch(), x);
    }
    [[nodiscard]] Real largest_contact_displacement(const State<Real>& x) const {
        const Probe<Real>& depth = legs_.depth();
        return std::abs(depth.rest() + scene_.gap) + depth.swing() + decaying(legs_.contact(), depth, x);
    }
    // State at phase 0 of the motion that never touches, and of the one that never leaves.
    [[nodiscard]] State<Real> steady_flight() const { return steady_at_phase_0(legs_.flight()); }
    [[nodiscard]] State<Real> steady_contact() const { return steady_at_phase_0(legs_.contact()); }
    [[nodiscard]] Jacobian<Real> flight_jacobian() const { return legs_.flight().flow(scene_.period()); }
    [[nodiscard]] Jacobian<Real> contact_jacobian() const { return legs_.contact().flow(scene_.period()); }

  private:
    static State<Real> steady_at_phase_0(const LinearMotion<Real>& motion) {
        State<Real> x = motion.steady(0, 1);
        x[0] += motion.rest();
        return x;
    }
    static Real decaying(const LinearMotion<Real>& motion, const Probe<Real>& probe, const State<Real>& x) {
        return probe.transient({.state = x, .homogeneous = x - steady_at_phase_0(motion)});
    }

    Oscillator<Real> scene_;
    LinearLegs<Real> legs_;
};

}  // namespace peterka::trajectory
