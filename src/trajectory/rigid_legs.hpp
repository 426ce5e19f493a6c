// The legs of a forcing cycle with a rigid stop: flights in closed form between impacts.
//
// A flight that starts from rest at the stop starts because nothing presses: while a <= 0 the hammer can't be
// back within half a natural period (the spring's response to a force of one sign keeps that sign for so long),
// so the search for the next impact begins at the end of the shorter of the two times.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "motion/linear_motion.hpp"
#include "motion/signal.hpp"
#include "trajectory/first_crossing.hpp"
#include "trajectory/journey.hpp"
#include "trajectory/leg_record.hpp"
#include "trajectory/rigid_course.hpp"
#include "trajectory/spring_change.hpp"

namespace peterka::trajectory {

template <class Real>
class RigidLegs {
  public:
    // The springs of an oscillator, without their cubic part or with this change.
    explicit RigidLegs(const Oscillator<Real>& oscillator)
        : RigidLegs(oscillator, motion::flight_equation(oscillator)) {}
    RigidLegs(const Oscillator<Real>& oscillator, const SpringChange<Real>& change)
        : RigidLegs(oscillator, change(motion::flight_equation(oscillator))) {}

    // From a state at a time since the cycle began.
    [[nodiscard]] Journey<Real> depart(const State<Real>& x, Real from = 0) const {
        return course_.depart(x, from);
    }

    // Runs through all events until `end`, in tau since the cycle began. False if it fails; the cycle says why.
    bool run(Journey<Real>& journey, Real end, Recorder<Real>* recorder) const {
        return course_.run(journey, end, recorder, [&](Journey<Real>& flying, Real end_time) {
            return fly(flying, end_time, recorder);
        });
    }

    // At the end of the cycle.
    void arrive(Journey<Real>& journey, Recorder<Real>* recorder) const { course_.arrive(journey, recorder); }

  private:
    RigidLegs(const Oscillator<Real>& oscillator, const motion::LinearEquation<Real>& flight)
        : oscillator_(oscillator),
          flight_(flight),
          touch_({.position = 1}, flight_),
          course_(oscillator, {oscillator, flight}) {}

    static bool from_rest(const Leg<Real>& leg) {
        return leg.start().state[0] == 0 && leg.start().state[1] == 0;
    }
    // A hammer that starts from rest doesn't turn back within this time: while a <= 0, delta' is the sum of the
    // impulse response's slopes, which are positive up to 1/(w + 2 b) at least.
    [[nodiscard]] Real fall_time(Real theta) const {
        const Real slopes = 1 / (flight_.natural_frequency() + 2 * flight_.equation().damping);
        return std::min(slopes, course_.stop().ahead_to_pressing(theta) / oscillator_.frequency);
    }
    [[nodiscard]] Crossing<Real> next_touch(const Leg<Real>& leg, Real theta, Real left) const;
    bool fly(Journey<Real>& journey, Real end, Recorder<Real>* recorder) const;

    Oscillator<Real> oscillator_;
    motion::LinearMotion<Real> flight_;
    Probe<Real> touch_;
    RigidCourse<Real> course_;
};

template <class Real>
Crossing<Real> RigidLegs<Real>::next_touch(const Leg<Real>& leg, Real theta, Real left) const {
    const Moment<Real>& start = leg.start();
    if (!from_rest(leg)) return first_crossing(leg, touch_, start, left);
    const Real away = std::min(std::numbers::pi_v<Real> / flight_.natural_frequency(),
                               course_.stop().ahead_to_pressing(theta) / oscillator_.frequency);
    if (away >= left) return {Crossing<Real>::Ending::none, leg.at(left), 0};
    return first_crossing(leg, touch_, leg.at(away), left);
}

// Flies until the next impact, without executing it, or the end. False if the journey ends early.
template <class Real>
bool RigidLegs<Real>::fly(Journey<Real>& journey, Real end_time, Recorder<Real>* recorder) const {
    using Ending = typename Crossing<Real>::Ending;
    Cycle<Real>& cycle = journey.cycle;
    const Real theta = oscillator_.frequency * journey.time;
    const Leg<Real> leg(flight_, cycle.end, theta);
    const Real left = end_time - journey.time;
    const Crossing<Real> touch = next_touch(leg, theta, left);
    if (touch.ending == Ending::exhausted) return journey.stop(Cycle<Real>::Outcome::too_many_events);
    const bool hits = touch.ending == Ending::crossing;
    const Moment<Real> end = hits ? touch.moment : leg.at(left);
    cycle.separated = true;
    if (recorder != nullptr) {
        recorder->displacement_bound(displacement_bound(oscillator_, touch_, leg, end.time));
        if (recorder->records_contacts()) {
            // from rest the hammer falls away for a while; its first steps are too short to search in
            const Real falls = from_rest(leg) ? fall_time(theta) / 2 : Real(0);
            const Moment<Real> from = falls < end.time ? leg.at(falls) : end;
            record_contacts<Real>(oscillator_, leg, falls > 0 ? from : leg.start(), end, nullptr, *recorder);
        }
        observe_leg(Phase::flight, leg, journey.time, end.time, *recorder);
    }
    cycle.jacobian = (end.flow * cycle.jacobian).eval();
    cycle.end = end.state;
    if (touch.ending == Ending::not_finite || !cycle.end.allFinite() || !cycle.jacobian.allFinite()) {
        return journey.stop(Cycle<Real>::Outcome::not_finite);
    }
    if (hits || cycle.end[0] > 0) cycle.end[0] = 0;  // by less than the rounding error
    journey.time = hits ? journey.time + end.time : end_time;
    return true;
}

}  // namespace peterka::trajectory
