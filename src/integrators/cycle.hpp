// A cycle as a chain of integrated legs, for either integrator of integrators/steppers.hpp.
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "integrators/events.hpp"
#include "integrators/steppers.hpp"
#include "support/stop_request.hpp"
#include "trajectory/recorder.hpp"
#include "trajectory/rigid_course.hpp"

namespace peterka::integrators {

using trajectory::append;
using trajectory::at_release;
using trajectory::Cycle;
using trajectory::Journey;
using trajectory::phase_of;
using trajectory::Recorder;
using trajectory::response_length;
using trajectory::RigidCourse;
using trajectory::RigidStop;

template <class Stepper>
class CycleIntegration {
  public:
    CycleIntegration(const Oscillator<double>& oscillator, typename Stepper::Method method,
                     double local_tolerance)
        : leg_(std::make_unique<SundialsLeg>(SundialsLeg{oscillator, local_tolerance})),
          stepper_(std::make_unique<Stepper>(*leg_, method)),
          events_(*leg_, *stepper_) {
        if (scene::is_rigid(oscillator.contact)) {
            course_.emplace(oscillator, RigidStop<double>(oscillator));
        }
    }

    [[nodiscard]] const Oscillator<double>& oscillator() const { return leg_->oscillator; }
    // From the state x at tau = from to tau = to, within one cycle.
    [[nodiscard]] Cycle<double> cycle(const State<double>& x, double from, double to,
                                      Recorder<double>* recorder);

  private:
    using Outcome = typename Cycle<double>::Outcome;

    struct LegEnd {
        enum class Kind { event, cycle, failure };
        Kind kind = Kind::failure;
        Phase next = Phase::flight;
        LegPoint point{};
    };

    LegEnd integrate_leg(const State<double>& x, double length, Recorder<double>* recorder);
    using Integrals = typename StepEvents<Stepper>::Integrals;
    void record_step(const LegPoint& end, Integrals& integrals, Recorder<double>& recorder);
    void record_leg(const State<double>& start, const LegPoint& end, const Integrals& integrals,
                    Recorder<double>& recorder) const;
    // With a compliant stop, and with a rigid one.
    Cycle<double> pressing_cycle(const State<double>& x, double from, double to, Recorder<double>* recorder);
    Cycle<double> striking_cycle(const State<double>& x, double from, double to, Recorder<double>* recorder);
    // A hammer that leaves its rest on the stop can't return before it is pressed again, or before its spring
    // swings back.
    [[nodiscard]] double time_away(double theta) const {
        const double stiffening =
            3 * std::abs(leg_->oscillator.cubic) * (1 + leg_->oscillator.gap * leg_->oscillator.gap);
        return std::min(1 / std::sqrt(1 + stiffening),
                        course_->stop().ahead_to_pressing(theta) / leg_->oscillator.frequency);
    }
    bool fly(Journey<double>& journey, double end_time, Recorder<double>* recorder);
    // Why the last leg failed.
    [[nodiscard]] Outcome failure() const { return runs_away() ? Outcome::not_finite : Outcome::solver_failed; }
    [[nodiscard]] bool runs_away() const;
    void enter(Phase from, Phase next, double time, Cycle<double>& cycle, Recorder<double>* recorder) const;

    std::unique_ptr<SundialsLeg> leg_;
    std::unique_ptr<Stepper> stepper_;
    StepEvents<Stepper> events_;
    std::optional<RigidCourse<double>> course_;  // for a rigid stop
    int steps_ = 0;                              // in this cycle
    double leg_start_ = 0;                       // tau within the cycle
};

template <class Stepper>
auto CycleIntegration<Stepper>::integrate_leg(const State<double>& x, double length, Recorder<double>* recorder)
    -> LegEnd {
    constexpr int most_steps = 200'000;  // per cycle: a second of work; a scene that needs more is too stiff
    constexpr double longest_step =
        0.5;  // in radians of the spring and of the forcing, since events are searched within a step
    const double instant = 1e-14 * leg_->oscillator.period();  // too short for an integrator
    if (length <= instant) return {LegEnd::Kind::cycle, leg_->phase, extrapolated(*leg_, {.state = x}, length)};
    Integrals integrals;
    stepper_->start(x, length, longest_step / std::max(1.0, leg_->oscillator.frequency));
    while (++steps_ <= most_steps && stepper_->step()) {
        stop_if_asked();
        if (!(stepper_->now().time > stepper_->before().time)) break;  // lost in rounding
        const auto event = events_.first_event();
        const LegPoint end = event ? event->point : stepper_->now();
        if (recorder != nullptr) record_step(end, integrals, *recorder);
        if (events_.failed()) break;
        if (!event && end.time < length) continue;
        if (recorder != nullptr) record_leg(x, end, integrals, *recorder);
        if (event) return {LegEnd::Kind::event, event->next, end};
        return {LegEnd::Kind::cycle, leg_->phase, end};
    }
    return {};
}

// Where softening springs push outward, they throw the hammer beyond any bound within a finite time, towards
// which an integrator takes ever shorter steps until time stands still in rounding.
template <class Stepper>
bool CycleIntegration<Stepper>::runs_away() const {
    constexpr double instant = 1e-12;  // of a cycle, in which the hammer would go as far again
    const auto& oscillator = leg_->oscillator;
    const State<double>& state = stepper_->now().state;
    const double u = state[0] + oscillator.gap;
    const bool is_pushed_outward = 1 + oscillator.cubic * u * u < 0;
    const bool flees = u * state[1] > 0 && std::abs(state[1]) * instant * oscillator.period() > std::abs(u);
    return is_pushed_outward && flees;
}

template <class Stepper>
void CycleIntegration<Stepper>::record_step(const LegPoint& end, Integrals& integrals,
                                            Recorder<double>& recorder) {
    const auto& totals = recorder.totals();
    const bool presses = leg_->phase == Phase::contact;
    if (presses) recorder.force(events_.largest_force(end, recorder.force_to_beat()));
    recorder.displacement_bound(events_.displacement_bound(end, totals.displacement_bound));
    if (auto* observer = recorder.observer(); observer != nullptr) {
        const double before = stepper_->before().time;
        observer->stretch(leg_->phase, leg_start_ + before, end.time - before,
                          [&](double t) { return events_.state_at(before + t); });
    }
    if (!recorder.records_contacts()) return;
    recorder.displacement(events_.largest_displacement(end, totals.largest_displacement));
    if (presses || recorder.records_energy()) events_.add_integrals(end, integrals);
}

// The stop's impulse and work follow from the balances of momentum and energy: as accurate as the integration,
// and independent of the force itself, which is noise in a stiff contact.
template <class Stepper>
void CycleIntegration<Stepper>::record_leg(const State<double>& start, const LegPoint& end,
                                           const Integrals& integrals, Recorder<double>& recorder) const {
    if (recorder.records_energy()) recorder.energy(integrals.drive_work, integrals.damper_work);
    if (!recorder.records_contacts() || leg_->phase != Phase::contact) return;
    const double slowing = start[1] - end.state[1];
    const double mean = (start[1] + end.state[1]) / 2;
    recorder.press(
        {.impulse = slowing + integrals.push, .time = end.time, .work = slowing * mean + integrals.push_work});
}

// Puts the state exactly on the surface of the event that leads into a phase, and counts it.
template <class Stepper>
void CycleIntegration<Stepper>::enter(Phase from, Phase next, double time, Cycle<double>& cycle,
                                      Recorder<double>* recorder) const {
    const auto& oscillator = leg_->oscillator;
    if (next == Phase::flight) {
        cycle.end[0] = 0;
        if (recorder != nullptr) recorder->leave();
    }
    if (next == Phase::contact) {
        const bool resumes = from == Phase::unloaded && cycle.end[1] < 0;  // rising, it can only be a new touch
        if (resumes) {
            cycle.end = at_release(oscillator, cycle.end);
        } else {
            ++cycle.impacts;
            cycle.last_touch = time;
            if (recorder != nullptr) recorder->touch({oscillator.frequency * time, cycle.end[1]});
            cycle.end[0] = 0;
            // saltation matrix (Leine & Nijmeijer 2004): the force jumps by this times the speed
            cycle.jacobian.row(1) -=
                contact_response(oscillator, cycle.end).by_velocity * cycle.jacobian.row(0);
        }
    }
    // the end of a contact is one token, wherever the stop lets go
    if (from == Phase::contact) cycle.pattern = append(cycle.pattern, pattern_of(Phase::unloaded));
    if (next == Phase::contact) cycle.pattern = append(cycle.pattern, pattern_of(Phase::contact));
}

template <class Stepper>
Cycle<double> CycleIntegration<Stepper>::cycle(const State<double>& x, double from, double to,
                                               Recorder<double>* recorder) {
    events_.forget_failure();
    steps_ = 0;
    if (!x.allFinite() || !std::isfinite(leg_->oscillator.period()))
        return {.outcome = Outcome::not_finite, .end = x};
    return course_ ? striking_cycle(x, from, to, recorder) : pressing_cycle(x, from, to, recorder);
}

template <class Stepper>
Cycle<double> CycleIntegration<Stepper>::pressing_cycle(const State<double>& x, double from, double to,
                                                        Recorder<double>* recorder) {
    constexpr int most_legs = 5'000;  // a cycle with more contacts is unphysical
    const auto& oscillator = leg_->oscillator;
    Cycle<double> cycle;
    cycle.end = x;
    Phase phase = phase_of(oscillator, x);
    cycle.pattern = pattern_of(phase);
    double time = from;
    for (int legs = 0; legs < most_legs; ++legs) {
        leg_->phase = phase;
        leg_->start_angle = oscillator.frequency * time;
        leg_start_ = time;
        cycle.touched |= phase == Phase::contact;
        cycle.separated |= phase == Phase::flight;
        const LegEnd end = integrate_leg(cycle.end, to - time, recorder);
        if (end.kind == LegEnd::Kind::failure) {
            cycle.outcome = failure();
            return cycle;
        }
        cycle.end = end.point.state;
        cycle.jacobian = (end.point.flow * cycle.jacobian).eval();
        if (!cycle.end.allFinite() || !cycle.jacobian.allFinite()) {
            cycle.outcome = Outcome::not_finite;
            return cycle;
        }
        if (end.kind == LegEnd::Kind::cycle) return cycle;
        time += end.point.time;
        enter(phase, end.next, time, cycle, recorder);
        phase = end.next;
    }
    cycle.outcome = Outcome::too_many_events;
    return cycle;
}

template <class Stepper>
Cycle<double> CycleIntegration<Stepper>::striking_cycle(const State<double>& x, double from, double to,
                                                        Recorder<double>* recorder) {
    Journey<double> journey = course_->depart(x, from);
    const auto flight = [&](Journey<double>& flying, double end_time) {
        return fly(flying, end_time, recorder);
    };
    if (course_->run(journey, to, recorder, flight)) course_->arrive(journey, recorder);
    return journey.cycle;
}

template <class Stepper>
bool CycleIntegration<Stepper>::fly(Journey<double>& journey, double end_time, Recorder<double>* recorder) {
    constexpr double low = 1e-3;  // of the response's size: the floor of the error weights
    const auto& oscillator = leg_->oscillator;
    Cycle<double>& cycle = journey.cycle;
    const double speed = -cycle.end[1];
    leg_->start_angle = oscillator.frequency * journey.time;
    leg_start_ = journey.time;
    leg_->hop_speed = cycle.end[0] == 0 && speed > 0 && speed < low * response_length(oscillator) ? speed : 0;
    const bool from_rest = cycle.end[0] == 0 && speed == 0;
    events_.trust_after(from_rest ? time_away(leg_->start_angle) : 0);
    cycle.separated = true;

    const LegEnd end = integrate_leg(cycle.end, end_time - journey.time, recorder);
    if (end.kind == LegEnd::Kind::failure) return journey.stop(failure());
    const bool hits = end.kind == LegEnd::Kind::event;
    cycle.end = end.point.state;
    cycle.jacobian = (end.point.flow * cycle.jacobian).eval();
    if (!cycle.end.allFinite() || !cycle.jacobian.allFinite()) return journey.stop(Outcome::not_finite);
    if (hits || cycle.end[0] > 0) cycle.end[0] = 0;  // within the error of the integration
    journey.time = hits ? journey.time + end.point.time : end_time;
    return true;
}

}  // namespace peterka::integrators
