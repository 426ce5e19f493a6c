// The stroboscopic map of the hammer: one forcing cycle, from phase 0 to phase 0, in closed form.
//
// A cycle is a chain of legs, each linear: flight (delta < 0), contact (the stop presses), and unloaded (delta
// > 0 but kappa delta + chi delta' < 0: the stop has let go and doesn't pull; eqs. 8-12 of Aguiar & Weber).
// Contact starts when delta rises through 0 and ends when the force falls through 0; while unloaded it resumes
// when the force would rise through 0, which belongs to the same impact. The phase is a function of the state
// alone, so a cycle is a map.
//
// The Jacobian is the product of the legs' flows and of the saltation matrix [[1, 0], [-chi, 1]] at each entry,
// where the force jumps by chi v; release and renewed contact are continuous and have the identity.
#pragma once

#include <cstdint>
#include <limits>

#include "motion/linear_motion.hpp"
#include "motion/signal.hpp"
#include "scene/oscillator.hpp"
#include "trajectory/first_crossing.hpp"
#include "trajectory/peak_force.hpp"

namespace peterka::trajectory {

using motion::LinearMotion;
using motion::Signal;
using scene::Jacobian;
using scene::Oscillator;
using scene::State;

enum class Phase : std::uint8_t { flight, contact, unloaded };

// Order and kind of the contacts in a cycle; two cycles with equal patterns lie on one smooth branch of the
// map. A hash of the sequence: equal sequences are told apart from unequal ones with a chance of error of
// 2^-64.
using EventPattern = std::uint64_t;

constexpr EventPattern append(EventPattern pattern, EventPattern next) {
    return pattern == 0 ? next : (pattern ^ next) * 0x100000001b3ULL;
}

template <class Real>
struct Cycle {
    enum class Outcome { done, too_many_events, not_finite };
    Outcome outcome = Outcome::done;
    State<Real> end;
    Jacobian<Real> jacobian;
    EventPattern pattern = 0;
    int impacts = 0;         // upward crossings of delta = 0
    bool touched = false;    // the stop pressed at some time
    bool separated = false;  // delta < 0 at some time
    Real peak_force = 0;     // largest F/(k A0), where asked for
};

template <class Real>
class ExactCycleMap {
  public:
    explicit ExactCycleMap(const Oscillator<Real>& scene)
        : scene_(scene),
          flight_(motion::flight_equation(scene)),
          contact_(motion::contact_equation(scene)),
          touch_({.position = 1}, flight_),
          leave_({.position = -1}, flight_),
          resume_(force(), flight_),
          release_(-force(), contact_),
          peak_(force(), contact_) {}

    [[nodiscard]] const Oscillator<Real>& scene() const { return scene_; }

    [[nodiscard]] Phase phase_of(const State<Real>& x) const {
        if (x[0] < 0 || (x[0] == 0 && x[1] <= 0)) return Phase::flight;
        return force_at(x) > 0 || x[0] == 0 ? Phase::contact : Phase::unloaded;
    }

    // One cycle from the state x at forcing phase 0.
    [[nodiscard]] Cycle<Real> operator()(const State<Real>& x, bool measure_force) const;

    // The decaying rest of a free flight can no longer lift the hammer to the stop: it never impacts again.
    [[nodiscard]] bool stays_free(const State<Real>& x) const {
        return phase_of(x) == Phase::flight &&
               touch_.rest() + touch_.swing() + decaying(flight_, touch_, x) < 0;
    }

    // The decaying rest of a contact can no longer make the force vanish: it presses for ever.
    [[nodiscard]] bool stays_in_contact(const State<Real>& x) const {
        return phase_of(x) == Phase::contact &&
               release_.rest() + release_.swing() + decaying(contact_, release_, x) < 0;
    }

    // Largest force of a contact that lasts for ever: once its transient is gone, and from the state x on.
    [[nodiscard]] Real steady_contact_force() const { return release_.swing() - release_.rest(); }
    [[nodiscard]] Real largest_contact_force(const State<Real>& x) const {
        return steady_contact_force() + decaying(contact_, release_, x);
    }
    // State at phase 0 of the motion that never touches, and of the one that never leaves.
    [[nodiscard]] State<Real> steady_flight() const { return steady_at_phase_0(flight_); }
    [[nodiscard]] State<Real> steady_contact() const { return steady_at_phase_0(contact_); }
    [[nodiscard]] Jacobian<Real> flight_jacobian() const { return flight_.flow(scene_.period()); }
    [[nodiscard]] Jacobian<Real> contact_jacobian() const { return contact_.flow(scene_.period()); }

  private:
    struct LegEnd {
        typename Search<Real>::Outcome outcome;
        Phase next;
        Moment<Real> moment;
    };

    [[nodiscard]] Signal<Real> force() const {
        return {.position = scene_.contact_stiffness, .velocity = scene_.contact_damping};
    }
    [[nodiscard]] Real force_at(const State<Real>& x) const {
        return scene_.contact_stiffness * x[0] + scene_.contact_damping * x[1];
    }
    static State<Real> steady_at_phase_0(const LinearMotion<Real>& motion) {
        State<Real> x = motion.steady(0, 1);
        x[0] += motion.rest();
        return x;
    }
    static Real decaying(const LinearMotion<Real>& motion, const Probe<Real>& probe, const State<Real>& x) {
        return probe.transient({.state = x, .homogeneous = x - steady_at_phase_0(motion)});
    }

    [[nodiscard]] LegEnd end_of_leg(Phase phase, const Leg<Real>& leg, Real end) const;

    Oscillator<Real> scene_;
    LinearMotion<Real> flight_;
    LinearMotion<Real> contact_;
    Probe<Real> touch_;
    Probe<Real> leave_;
    Probe<Real> resume_;
    Probe<Real> release_;
    PeakForce<Real> peak_;
};

template <class Real>
typename ExactCycleMap<Real>::LegEnd ExactCycleMap<Real>::end_of_leg(Phase phase, const Leg<Real>& leg,
                                                                     Real end) const {
    using Outcome = typename Search<Real>::Outcome;
    if (phase == Phase::unloaded) {
        const auto out = first_crossing(leg, leave_, leg.start(), end);
        const bool leaves = out.outcome == Outcome::crossing;
        const auto back = first_crossing(leg, resume_, leg.start(), leaves ? out.moment.time : end);
        if (back.outcome != Outcome::none) return {back.outcome, Phase::contact, back.moment};
        return {out.outcome, Phase::flight, out.moment};
    }
    const auto found = first_crossing(leg, phase == Phase::flight ? touch_ : release_, leg.start(), end);
    return {found.outcome, phase == Phase::flight ? Phase::contact : Phase::unloaded, found.moment};
}

template <class Real>
Cycle<Real> ExactCycleMap<Real>::operator()(const State<Real>& x, bool measure_force) const {
    using Outcome = typename Search<Real>::Outcome;
    constexpr int most_legs = 20'000;  // a cycle with more contacts than this has left physics

    const Real period = scene_.period();
    Cycle<Real> cycle;
    cycle.end = x;
    cycle.jacobian.setIdentity();
    Phase phase = phase_of(x);
    cycle.pattern = static_cast<EventPattern>(phase) + 1;
    Real time = 0;
    for (int legs = 0; legs < most_legs; ++legs) {
        const Leg<Real> leg(phase == Phase::contact ? contact_ : flight_, cycle.end, scene_.frequency * time);
        const Real left = period - time;
        const LegEnd event = end_of_leg(phase, leg, left);
        if (event.outcome == Outcome::exhausted) break;
        if (event.outcome == Outcome::not_finite) {
            cycle.outcome = Cycle<Real>::Outcome::not_finite;
            return cycle;
        }
        const bool last = event.outcome == Outcome::none;
        const Moment<Real> end = last ? leg.at(left) : event.moment;

        cycle.touched |= phase == Phase::contact;
        cycle.separated |= phase == Phase::flight;
        if (measure_force && phase == Phase::contact) {
            cycle.peak_force = peak_.over(leg, end, cycle.peak_force);
        }
        cycle.jacobian = end.flow * cycle.jacobian;
        cycle.end = end.state;
        if (!cycle.end.allFinite() || !cycle.jacobian.allFinite()) {
            cycle.outcome = Cycle<Real>::Outcome::not_finite;
            return cycle;
        }
        if (last) return cycle;

        // Each event puts the state exactly on its surface: in a stiff stop a rounding error of the position is
        // energy.
        if (event.next == Phase::flight) cycle.end[0] = 0;
        if (event.next == Phase::contact) {
            const bool resumes =
                phase == Phase::unloaded && cycle.end[1] < 0;  // rising, it can only be a new touch
            if (resumes) {
                cycle.end[0] = -scene_.contact_damping / scene_.contact_stiffness * cycle.end[1];
            } else {
                ++cycle.impacts;
                cycle.end[0] = 0;
                cycle.jacobian.row(1) -= scene_.contact_damping * cycle.jacobian.row(0);
            }
        }
        time += end.time;
        phase = event.next;
        if (phase !=
            Phase::flight) {  // where the hammer leaves delta > 0 while unloaded makes no difference to the map
            cycle.pattern = append(cycle.pattern, static_cast<EventPattern>(phase) + 1);
        }
    }
    cycle.outcome = Cycle<Real>::Outcome::too_many_events;
    return cycle;
}

}  // namespace peterka::trajectory
