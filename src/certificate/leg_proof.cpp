#include "certificate/leg_proof.hpp"

#include <algorithm>

#include "certificate/safe_step.hpp"

namespace peterka::certificate {
namespace {

constexpr int most_steps_of_a_leg = 100'000;

// A time before the end, at which the signal reaches 0 from below, during which it surely was below 0.
double surely_before(const Springs<Interval>& springs, const Phase<Interval>& phase, Signal signal,
                     const Moment<Interval>& end) {
    const Watched watched = watch(springs, phase, signal, end);
    if (!watched.slope.positive()) return 0;
    const double cap = short_time(phase);
    const double bend = bend_of(springs, signal, bends(phase, end, cap, Within::both_ways));
    const double time = std::min(cap, 1.9 * watched.slope.lo / bend);
    return (Interval(bend) * time / Interval(2)).hi < watched.slope.lo ? time : 0;
}

// The same before a grazing: from rest on the surface, with delta'' < 0.
double surely_before_grazing(const Phase<Interval>& phase, const Moment<Interval>& end) {
    const Interval acceleration = phase.acceleration({Interval(0), Interval(0)}, end.angle.sine);
    if (!acceleration.negative()) return 0;
    const double cap = short_time(phase);
    return std::min(cap, 2.9 * -acceleration.hi / bends(phase, end, cap, Within::both_ways).jerk);
}

Signal signal_of(EventKind kind) {
    switch (kind) {
        case EventKind::touch:
        case EventKind::bounce:
            return Signal::penetration;
        case EventKind::release:
            return Signal::pull;
        case EventKind::resume:
        case EventKind::resume_at_graze:
        case EventKind::graze:     // has none
        case EventKind::lift_off:  // ends a rest, not a leg
            break;
    }
    return Signal::force;
}

}  // namespace

bool March::step(double until, bool on_surface) {
    const Moment<Interval> now = offset_ == 0 ? leg_->start() : leg_->at(Interval(offset_));
    const bool must_stay_below = springs_->rig.rigid || (now.state.position.negative() && !on_surface);
    const Signal signal = presses_ ? Signal::pull : must_stay_below ? Signal::penetration : Signal::force;
    Watched watched = watch(*springs_, leg_->phase(), signal, now);
    if (on_surface) watched.value = 0;
    const Bends near = bends(leg_->phase(), now, cap_, Within::later);
    const double bend = bend_of(*springs_, signal, near);
    const double wanted = 0.95 * safe_step(watched.value.hi, watched.slope.hi, bend);
    const double end = offset_ + std::min({0.999 * cap_, wanted, until - offset_});
    const double time = (Interval(end) - Interval(offset_)).hi;
    if (!(end > offset_) || !(time <= cap_)) return false;
    const Interval by_slope = watched.slope * time + Interval(bend) * square(Interval(time)) / Interval(2);
    const bool begins_below = on_surface ? watched.slope.negative() : watched.value.negative();
    // Convex in the step: negative at both ends, hence also in between.
    if (!begins_below || !(watched.value + by_slope).negative()) return false;
    offset_ = end;
    return true;
}

bool March::leave_at_once(double until) {
    const Phase<Interval>& phase = leg_->phase();
    const Interval acceleration = phase.acceleration({Interval(0), Interval(0)}, leg_->start().angle.sine);
    if (!acceleration.negative()) return false;
    const double jerk = bends(phase, leg_->start(), cap_, Within::later).jerk;
    offset_ = std::min({0.999 * cap_, 2.9 * -acceleration.hi / jerk, until});
    return offset_ > 0;
}

bool March::lift_off(double until) {
    const Phase<Interval>& phase = leg_->phase();
    const Interval jerk = phase.jerk({Interval(0), Interval(0)}, Interval(0), leg_->start().angle);
    if (!jerk.negative()) return false;
    const double snap = bends(phase, leg_->start(), cap_, Within::later).snap;
    offset_ = std::min({0.999 * cap_, 3.9 * -jerk.hi / snap, until});
    return offset_ > 0;
}

bool March::begin(std::optional<EventKind> from, double until) {
    if (!from) {
        const Vector<Interval>& state = leg_->start().state;
        const bool on_surface = state.position.lo == 0 && state.position.hi == 0;
        return (!on_surface || state.velocity.negative()) && step(until, on_surface);
    }
    if (*from == EventKind::lift_off) return lift_off(until);
    const bool stops_there = *from == EventKind::bounce && springs_->rig.restitution.hi == 0;
    if (stops_there || *from == EventKind::graze) return leave_at_once(until);
    const bool presses_at_once = *from == EventKind::touch && springs_->rig.damping.positive();
    return step(until, !presses_at_once);
}

bool leg_is_free(const Springs<Interval>& springs, const EventChain& chain,
                 const std::vector<Place<Interval>>& places, std::size_t i) {
    const std::size_t next = chain.next(i);
    const auto [leg, length] = leg_of(springs, chain, places, i);
    return leg_is_free(springs, leg, length, chain.presses(i), chain.events[i].kind, chain.events[next].kind,
                       places[next]);
}

bool leg_is_free(const Springs<Interval>& springs, const Leg<Interval>& leg, const Interval& length,
                 bool presses, std::optional<EventKind> from, EventKind to, const Place<Interval>& end) {
    if (presses != (to == EventKind::release) || !length.positive()) return false;
    const Moment<Interval> met = leg.moment(scaled(springs.surface(to), end.along), end.time);
    if (to == EventKind::resume && !met.state.position.positive()) return false;
    const double before = to == EventKind::graze ? surely_before_grazing(leg.phase(), met)
                                                 : surely_before(springs, leg.phase(), signal_of(to), met);
    if (!(before > 0)) return false;
    const double until = (Interval(length.hi) - Interval(before)).hi;
    March march(springs, leg, presses);
    if (until > 0 && !march.begin(from, until)) return false;
    for (int steps = 0; march.offset() < until; ++steps) {
        if (steps == most_steps_of_a_leg || !march.step(until)) return false;
    }
    return true;
}

}  // namespace peterka::certificate
