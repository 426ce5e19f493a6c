// A forcing cycle against a rigid stop, whatever carries the flights: impacts, chatter and rest in sequence.
//
// The events at the stop are described in rigid_stop.hpp, and the effect of an impact on cycle and record in
// rigid_impact.hpp.
//
// A cycle has at most 10,000 impacts. With r above about 0.9986 a chatter may take more; the cycle's outcome is
// then too_many_events. The same happens to an elastic hammer (r = 1) that is pressed so hard that it hops more
// often.
#pragma once

#include <cmath>
#include <limits>
#include <numbers>

#include "support/stop_if_asked.hpp"
#include "trajectory/journey.hpp"

namespace peterka::trajectory {

template <class Real>
class RigidCourse {
  public:
    RigidCourse(const Oscillator<Real>& oscillator, const RigidStop<Real>& stop)
        : oscillator_(oscillator), stop_(stop) {}

    [[nodiscard]] const RigidStop<Real>& stop() const { return stop_; }

    // From a state at a time since the cycle began.
    [[nodiscard]] Journey<Real> depart(const State<Real>& x, Real from = 0) const;

    // Runs through all events until `end`, in tau since the cycle began. False if it fails; the cycle says why.
    // fly(journey, end) flies to the next impact, without executing it, or to the end; it is false if the
    // journey ends early.
    template <class Fly>
    bool run(Journey<Real>& journey, Real end, Recorder<Real>* recorder, Fly&& fly) const;

    // At the end of the cycle.
    void arrive(Journey<Real>& journey, Recorder<Real>* recorder) const {
        end_chain_before(2 * std::numbers::pi_v<Real>, journey.chain, recorder);
    }

  private:
    void hit(Journey<Real>& journey, Recorder<Real>* recorder) const;
    bool rest(Journey<Real>& journey, Real end, Recorder<Real>* recorder) const;

    Oscillator<Real> oscillator_;
    RigidStop<Real> stop_;
};

template <class Real>
Journey<Real> RigidCourse<Real>::depart(const State<Real>& x, Real from) const {
    // a start on the stop may be off by the rounding of its position
    const Real rounding = 16 * std::numeric_limits<Real>::epsilon() * (1 + std::abs(oscillator_.gap));
    Journey<Real> journey(oscillator_, x[0] > 0 && x[0] <= rounding ? State<Real>(0, x[1]) : x);
    journey.chain = chain_at_start(stop_, journey.cycle.pattern);
    if (x[0] > rounding) journey.stop(Cycle<Real>::Outcome::inside_stop);
    if (from > 0) {
        const bool rests = journey.cycle.end[0] == 0 && x[1] == 0;
        journey.phase = rests && stop_.presses(oscillator_.frequency * from) ? Phase::contact : Phase::flight;
        journey.time = journey.rest_from = from;
    }
    return journey;
}

template <class Real>
void RigidCourse<Real>::hit(Journey<Real>& journey, Recorder<Real>* recorder) const {
    const auto rest =
        strike(stop_, oscillator_.frequency * journey.time, journey.cycle, journey.chain, recorder);
    if (!rest) return;
    journey.phase = Phase::contact;
    journey.rest_from = journey.time + *rest;
}

// Rest on the stop. False if it lasts until the end.
template <class Real>
bool RigidCourse<Real>::rest(Journey<Real>& journey, Real end_time, Recorder<Real>* recorder) const {
    const Real from = journey.rest_from;
    const Real theta = oscillator_.frequency * from;
    const Real release =
        from + (stop_.presses(theta) ? stop_.ahead_to_release(theta) / oscillator_.frequency : 0);
    const bool lets_go = release < end_time;
    const Real begin = journey.time;
    journey.time = lets_go ? release : end_time;
    journey.rest_from = journey.time;
    journey.cycle.touched = true;
    journey.cycle.jacobian.setZero();
    if (recorder != nullptr) {
        record_sticking(stop_, theta, oscillator_.frequency * journey.time, *recorder);
        recorder->displacement_bound(std::abs(oscillator_.gap));
        recorder->displacement(std::abs(oscillator_.gap));
        if (auto* observer = recorder->observer(); observer != nullptr) {
            observer->stretch(Phase::contact, begin, journey.time - begin,
                              [](Real) -> State<Real> { return State<Real>::Zero(); });
        }
        if (lets_go) recorder->leave();
    }
    if (lets_go) journey.phase = Phase::flight;
    return lets_go;
}

template <class Real>
template <class Fly>
bool RigidCourse<Real>::run(Journey<Real>& journey, Real end_time, Recorder<Real>* recorder, Fly&& fly) const {
    constexpr int most_events = 20'000;
    const Cycle<Real>& cycle = journey.cycle;
    if (cycle.outcome != Cycle<Real>::Outcome::done) return false;
    for (; journey.events < most_events; ++journey.events) {
        stop_if_asked();
        const bool arrives = cycle.end[0] == 0 && cycle.end[1] > 0;
        if (journey.phase == Phase::contact) {
            if (!rest(journey, end_time, recorder)) return true;
        } else if (arrives) {
            hit(journey, recorder);
        } else if (journey.time >= end_time) {
            return true;
        } else if (!fly(journey, end_time)) {
            return false;
        }
    }
    return journey.stop(Cycle<Real>::Outcome::too_many_events);
}

}  // namespace peterka::trajectory
