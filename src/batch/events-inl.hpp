// Treatment of the lanes that an event stops on their march; included by kernel-inl.hpp.
#if defined(PETERKA_BATCH_EVENTS_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef PETERKA_BATCH_EVENTS_INL_HPP
#undef PETERKA_BATCH_EVENTS_INL_HPP
#else
#define PETERKA_BATCH_EVENTS_INL_HPP
#endif

#include "batch/kernel-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace peterka::batch::HWY_NAMESPACE {

template <Law law, bool own>
HWY_ATTR void Kernel<law, own>::strike() {
    const Waiting w = take(queues_.crossings);
    const Cells cells = cells_of(w.lanes);
    const MeetingMoment found =
        first_meeting(cells, w.moment, gather(lanes_[Field::delta], w.lanes),
                      gather(lanes_[Field::velocity], w.lanes), gather(lanes_[Field::margin], w.lanes));
    const Mask which = found.found;
    push(w.lanes, w.end, w.time, w.moment, ~which & real_, queues_.hops);
    if (any(which)) {
        Gathered track(lanes_, w.lanes);
        touch(cells, w.time + found.time, found.moment, until(w), which, track);
        track.keep(lanes_, w.lanes);
    }
}

// Events at the stop. False if no queue holds enough lanes to pay.
template <Law law, bool own>
HWY_ATTR bool Kernel<law, own>::drain_stop(auto is_ripe) {
    if constexpr (rigid) {
        if (is_ripe(queues_.turns)) {
            bounce();
        } else if (is_ripe(queues_.contacts)) {
            rest();
        } else {
            return false;
        }
    } else {
        if (is_ripe(queues_.contacts)) {
            stay();
        } else if (is_ripe(queues_.releases)) {
            release_all();
        } else if (is_ripe(queues_.turns)) {
            turn();
        } else if (cubic && is_ripe(queues_.held_contacts)) {
            kick_held(queues_.held_contacts, queues_.contacts, true);
        } else if (cubic && is_ripe(queues_.held_releases)) {
            kick_held(queues_.held_releases, queues_.releases, false);
        } else {
            return false;
        }
    }
    return true;
}

template <Law law, bool own>
HWY_ATTR void Kernel<law, own>::drain(std::size_t fill) {
    const auto is_ripe = [&](const Queue& queue) {
        return queue.size >= fill || (queue.size > 0 && queue.passes >= longest_wait);
    };
    // each round advances its lanes in time; lanes that need more rounds are left to the twin
    for (int round = 0; round < 100'000; ++round) {
        if (is_ripe(queues_.crossings)) {
            strike();
        } else if (is_ripe(queues_.hops)) {
            hop();
        } else if (!drain_stop(is_ripe)) {
            return;
        }
    }
    for (Queue* queue : queues_.events()) {
        while (queue->size > 0) {
            const Waiting w = take(*queue);
            leave_to_twin(cells_of(w.lanes), every());
        }
    }
}

template <Law law, bool own>
HWY_ATTR void Kernel<law, own>::hop() {
    const Waiting w = take(queues_.hops);
    const Cells cells = cells_of(w.lanes);
    const V length = mul_sub(w.end, cells.step, w.time);
    const Flight flight(cells, w.moment);
    const V fourth = flight.fourth_derivative_bound(gather(lanes_[Field::swing], w.lanes));
    const MeetingMoment found = seek_touch(cells, w.moment, length, fourth, every());
    leave_to_twin(cells, found.unsure);
    const Mask touches = found.found;
    const Mask stays_below = ~(found.unsure | touches);
    if (any(stays_below)) {
        const Moments end = end_of(flight, length);
        const Mask below = end.delta < all(0);
        arrive(cells, end.delta, end.velocity, w.end, fourth, stays_below & below);
        leave_to_twin(cells, ~below & stays_below);
        if constexpr (cubic) {
            Gathered track(lanes_, w.lanes);
            track.carry(flown(cells, mul_sub(w.end, cells.step, track.leg_start)), stays_below);
            track.keep(lanes_, w.lanes);
        }
    }
    if (any(touches)) {
        Gathered track(lanes_, w.lanes);
        touch(cells, w.time + found.time, found.moment, until(w), touches, track);
        track.keep(lanes_, w.lanes);
    }
}

template <Law law, bool own>
HWY_ATTR void Kernel<law, own>::arrive(const Cells& cells, V delta, V velocity, V grid_point,
                                       V fourth_derivative, Mask which) {
    put(delta, lanes_[Field::delta], cells.index, which);
    put(velocity, lanes_[Field::velocity], cells.index, which);
    put(grid_point, lanes_[Field::next], cells.index, which);
    put(hull_margin(fourth_derivative, cells.step), lanes_[Field::margin], cells.index, which);
}

// The hammer meets the stop.
template <Law law, bool own>
HWY_ATTR void Kernel<law, own>::touch(const Cells& cells, V time, const Moments& m, V until, Mask which,
                                      Gathered& track) {
    // a touch so slow that rounding decides it
    const V scale = cells.drive + abs(cells.gap) + all(1);
    const Mask slow = m.velocity * m.velocity <= all(1e-10) * scale * scale;
    leave_to_twin(cells, which & slow);
    which = ~slow & which;
    if constexpr (rigid) {
        end_leg(cells, time - track.leg_start, flown(cells, time - track.leg_start), which, track);
        rebound(cells, time, m, which, track);
    } else {
        press(cells, time, m, until, which, track);
    }
}

template <Law law, bool own>
HWY_ATTR void Kernel<law, own>::press(const Cells& cells, V time, const Moments& m, V until, Mask which,
                                      Gathered& track) {
    const V drive = cells.drive;
    track.impacts = choose(which, track.impacts + all(1), track.impacts);
    track.pattern = choose(which, append(track.pattern, trajectory::Phase::contact), track.pattern);
    if constexpr (!cubic) {
        const V duration = time - track.leg_start;
        track.raise_displacement(
            min(track.swing + track.leg_amplitude, mul_add(drive, duration, track.leg_energy)), which);
    }
    track.carry(flown(cells, time - track.leg_start), which);
    track.jump(all(cells.rig.damping), which);
    track.leg_start = choose(which, time, track.leg_start);

    Mask is_short = none();
    if constexpr (!own) is_short = touch_shortly(cells, time, m, until, which, track);
    push(cells.index, until, time, m, real_ & ~is_short & which, queues_.contacts);
}

// Handles the touches that are over soon, or would be without the next kick, and what follows. One long
// function: each part of it would need the contact, its release and the mask narrowed so far.
template <Law law, bool own>
HWY_ATTR Mask Kernel<law, own>::touch_shortly(const Cells& cells, V time, const Moments& m, V until, Mask which,
                                              Gathered& track) {
    const V drive = cells.drive;
    const V springs = cubic ? -(cells.square * cells.static_position) : cells.gap;  // their pull at the stop
    const V pull = mul_sub(drive, m.sine, springs);
    const V speed = m.velocity;
    V jerk = drive * cells.eta;
    if constexpr (cubic) {
        // The springs pull by (square - 1) delta more than the rig's contacts include, and the hammer's speed
        // stays below twice the initial speed plus what the pull adds.
        const V fastest = mul_add(abs(pull), all(rig_.latest_exit), all(2) * speed);
        jerk = mul_add(abs(cells.square - all(1)), fastest, jerk);
    }
    const Mask like_unforced = (pull >= all(rig_.least_pull) * speed) &
                               (pull <= all(rig_.largest_pull) * speed) &
                               (jerk <= all(rig_.largest_jerk) * speed);
    const Mask ends_before = time + all(rig_.latest_exit) < all(steps_) * cells.step;
    const Mask small_angle = cells.eta * all(rig_.latest_exit) < all(0.78);  // pi/4, the range of the series
    // up to the next kick
    const V left = mul_sub(until, cells.step, time);
    const Mask may_be_short = (cubic ? like_unforced : like_unforced & ends_before) & small_angle;
    Mask is_short = which & may_be_short;
    if (any(is_short)) {
        const Contact contact(lanes_, cells, m);
        const V share = mean_pull(rig_, cells, m, springs) / m.velocity * all(1 / rig_.pull_scale);
        const V bounded = max(min(share, all(1)), all(-1));
        const Release end = short_release(rig_, contact, bounded, is_short);
        is_short = is_short & end.sure;
        const Mask goes_on = cubic ? is_short & (end.time >= left) : none();  // at the stop at the next kick
        const V duration = cubic ? min(end.time, left) : end.time;
        const ContactPoint point = cubic && any(goes_on) ? contact.at(left) : end.point;
        const ShortPeak peak = short_peak(rig_, contact, bounded, is_short);
        is_short = is_short & peak.sure;
        const Mask rises = goes_on & (peak.time > left);
        const V largest =
            cubic && any(rises) ? choose(rises, contact.force(point).value, peak.force) : peak.force;
        track.peak_force = choose(is_short, max(track.peak_force, largest), track.peak_force);
        const V reach = gather(lanes_[Field::contact_swing], cells.index) + contact.amplitude(contact.start());
        const V contact_period = cubic ? all(1) / cells.contact_frequency : all(1 / rig_.contact_frequency);
        const V square_of_it = cubic ? contact_period * contact_period : all(1 / rig_.contact_square);
        const V energy = sqrt(mul_add(contact.static_position(), contact.static_position(),
                                      m.velocity * m.velocity * square_of_it));
        const V work = drive * duration * contact_period;
        track.raise_displacement(abs(contact.static_position() + cells.gap) + min(reach, energy + work),
                                 is_short);
        track.carry(contact.flow_for(duration), is_short);
        Mask leaves = is_short;
        if constexpr (cubic) {
            const Moments last = contact.moment(point);
            hold(cells, last.delta, last.velocity, until, is_short & goes_on, queues_.held_contacts);
            leaves = leaves & ~goes_on;
        }
        track.pattern = choose(leaves, append(track.pattern, trajectory::Phase::unloaded), track.pattern);
        release(cells, time + end.time, let_go(contact.moment(end.point)), until, leaves, track);
    }
    return is_short;
}

// A contact of any length, from its beginning or from that of the cycle.
template <Law law, bool own>
HWY_ATTR void Kernel<law, own>::stay() {
    const Waiting w = take(queues_.contacts);
    const Cells cells = cells_of(w.lanes);
    const Contact contact(lanes_, cells, w.moment);
    const V length = mul_sub(w.end, cells.step, w.time);
    const V zero = all(0);
    Sought end = seek(cells, contact, 0, all(-1), zero, contact.start(), length, every());
    Mask sure = ~end.unsure;
    const V duration = choose(end.found, end.time, length);
    Gathered track(lanes_, w.lanes);
    const Peak peak = long_peak(cells, contact, duration, sure);
    sure = sure & peak.sure;
    track.peak_force = choose(sure, max(track.peak_force, peak.force), track.peak_force);
    const V reach = gather(lanes_[Field::contact_swing], cells.index) + contact.amplitude(contact.start());
    const V stretch = w.moment.delta - contact.static_position();
    const V speed = w.moment.velocity / cells.contact_frequency;
    const V energy = sqrt(mul_add(stretch, stretch, speed * speed));
    const V work = cells.drive * duration / cells.contact_frequency;
    track.raise_displacement(abs(contact.static_position() + cells.gap) + min(reach, energy + work), sure);
    track.carry(contact.flow_for(duration), sure);
    leave_to_twin(cells, ~sure);

    const Mask stays = ~end.found & sure;
    if (any(stays)) {
        const Moments last = contact.moment(contact.at(length));
        if constexpr (cubic) {
            hold(cells, last.delta, last.velocity, w.end, stays, queues_.held_contacts);
        } else {
            arrive(cells, last.delta, last.velocity, all(steps_), zero, stays);
            track.leg_start = choose(stays, all(-1), track.leg_start);
        }
    }
    const Mask leaves = sure & end.found;
    track.pattern = choose(leaves, append(track.pattern, trajectory::Phase::unloaded), track.pattern);
    if (any(leaves)) release(cells, w.time + end.time, let_go(contact.moment(end.point)), w.end, leaves, track);
    track.keep(lanes_, w.lanes);
}

}  // namespace peterka::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
