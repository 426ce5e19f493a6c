// The legs of a forcing cycle: stretches of linear motion between the events at which the stop begins or ceases
// to press.
//
// A cycle is a chain of legs: flight (delta < 0), contact (the stop presses), and unloaded (delta > 0 but kappa
// delta + chi delta' < 0: the stop has let go and doesn't pull; eqs. 8-12 of Aguiar & Weber). Contact starts
// when delta rises through 0 and ends when the force falls through 0; while unloaded it resumes when the force
// would rise through 0, which belongs to the same impact. The phase is a function of the state alone, so a
// cycle is a map.
//
// The Jacobian is the product of the legs' flows and of the saltation matrix [[1, 0], [-chi, 1]] at each entry,
// where the force jumps by chi v (Leine & Nijmeijer 2004); at release and renewed contact the force is
// continuous and the matrix the identity.
#pragma once

#include <algorithm>
#include <cmath>

#include "motion/linear_motion.hpp"
#include "motion/signal.hpp"
#include "support/stop_if_asked.hpp"
#include "trajectory/first_crossing.hpp"
#include "trajectory/journey.hpp"
#include "trajectory/largest_value.hpp"
#include "trajectory/leg_record.hpp"
#include "trajectory/phase_ends.hpp"
#include "trajectory/recorder.hpp"
#include "trajectory/spring_change.hpp"

namespace peterka::trajectory {

using motion::LinearEquation;
using motion::LinearMotion;
using motion::Signal;

template <class Real>
class LinearLegs {
  public:
    // The springs of an oscillator, without their cubic part or with this change.
    explicit LinearLegs(const Oscillator<Real>& oscillator)
        : LinearLegs(oscillator, motion::flight_equation(oscillator), motion::contact_equation(oscillator)) {}
    LinearLegs(const Oscillator<Real>& oscillator, const SpringChange<Real>& change)
        : LinearLegs(oscillator, change(motion::flight_equation(oscillator)),
                     change(motion::contact_equation(oscillator))) {}

    // From a state at a time since the cycle began.
    [[nodiscard]] Journey<Real> depart(const State<Real>& x, Real from = 0) const {
        Journey<Real> journey(oscillator_, x);
        journey.time = from;
        return journey;
    }

    // Runs through all events until `end`, in tau since the cycle began. False if it fails; the cycle says why.
    bool run(Journey<Real>& journey, Real end, Recorder<Real>* recorder) const;

    // At the end of the cycle.
    void arrive(Journey<Real>& /*journey*/, Recorder<Real>* /*recorder*/) const {}

  private:
    // The equations of flight and contact, in the penetration.
    LinearLegs(const Oscillator<Real>& oscillator, const LinearEquation<Real>& flight,
               const LinearEquation<Real>& contact)
        : oscillator_(oscillator),
          flight_(flight),
          contact_(contact),
          phase_ends_(force(), flight_, contact_),
          depth_({.position = 1}, contact_),
          peak_(force(), contact_) {}

    [[nodiscard]] Signal<Real> force() const {
        return {.position = oscillator_.kelvin_voigt().stiffness,
                .velocity = oscillator_.kelvin_voigt().damping};
    }

    void record(Phase phase, const Leg<Real>& leg, const Moment<Real>& end, Recorder<Real>& recorder) const;
    void enter(Phase next, Journey<Real>& journey, Recorder<Real>* recorder) const;

    Oscillator<Real> oscillator_;
    LinearMotion<Real> flight_;
    LinearMotion<Real> contact_;
    PhaseEnds<Real> phase_ends_;
    Probe<Real> depth_;
    LargestValue<Real> peak_;
};

template <class Real>
void LinearLegs<Real>::record(Phase phase, const Leg<Real>& leg, const Moment<Real>& end,
                              Recorder<Real>& recorder) const {
    const bool presses = phase == Phase::contact;
    if (presses) recorder.force(peak_.over(leg, leg.start(), end, recorder.force_to_beat()));
    recorder.displacement_bound(
        displacement_bound(oscillator_, presses ? depth_ : phase_ends_.touch(), leg, end.time));
    if (recorder.records_contacts()) {
        record_contacts(oscillator_, leg, leg.start(), end, presses ? &peak_.signal() : nullptr, recorder);
    }
}

// Each event puts the state exactly on its surface: in a stiff stop a rounding error of the position is energy.
template <class Real>
void LinearLegs<Real>::enter(Phase next, Journey<Real>& journey, Recorder<Real>* recorder) const {
    Cycle<Real>& cycle = journey.cycle;
    if (next == Phase::flight) {
        cycle.end[0] = 0;
        if (recorder != nullptr) recorder->leave();
    }
    if (next == Phase::contact) {
        // rising, it can only be a new touch
        const bool resumes = journey.phase == Phase::unloaded && cycle.end[1] < 0;
        if (resumes) {
            cycle.end[0] =
                -oscillator_.kelvin_voigt().damping / oscillator_.kelvin_voigt().stiffness * cycle.end[1];
        } else {
            ++cycle.impacts;
            cycle.last_touch = journey.time;
            if (recorder != nullptr) recorder->touch({oscillator_.frequency * journey.time, cycle.end[1]});
            cycle.end[0] = 0;
            cycle.jacobian.row(1) -= oscillator_.kelvin_voigt().damping * cycle.jacobian.row(0);
        }
    }
    journey.phase = next;
    if (next != Phase::flight) cycle.pattern = append(cycle.pattern, pattern_of(next));
}

template <class Real>
bool LinearLegs<Real>::run(Journey<Real>& journey, Real end_time, Recorder<Real>* recorder) const {
    using Ending = typename Crossing<Real>::Ending;
    constexpr int most_events = 20'000;  // more contacts than any physical cycle has

    Cycle<Real>& cycle = journey.cycle;
    while (journey.events < most_events) {
        stop_if_asked();
        const Phase phase = journey.phase;
        const Leg<Real> leg(phase == Phase::contact ? contact_ : flight_, cycle.end,
                            oscillator_.frequency * journey.time);
        const Real left = end_time - journey.time;
        const auto event = phase_ends_.first_on(phase, leg, left);
        if (event.ending == Ending::exhausted) break;
        if (event.ending == Ending::not_finite) return journey.stop(Cycle<Real>::Outcome::not_finite);
        const bool last = event.ending == Ending::none;
        const Moment<Real> end = last ? leg.at(left) : event.moment;

        cycle.touched |= phase == Phase::contact;
        cycle.separated |= phase == Phase::flight;
        if (recorder != nullptr) {
            record(phase, leg, end, *recorder);
            observe_leg(phase, leg, journey.time, end.time, *recorder);
        }
        cycle.jacobian = end.flow * cycle.jacobian;
        cycle.end = end.state;
        if (!cycle.end.allFinite() || !cycle.jacobian.allFinite()) {
            return journey.stop(Cycle<Real>::Outcome::not_finite);
        }
        if (last) {
            journey.time = end_time;
            return true;
        }
        journey.time += end.time;
        enter(event.next, journey, recorder);
        ++journey.events;
    }
    return journey.stop(Cycle<Real>::Outcome::too_many_events);
}

}  // namespace peterka::trajectory
