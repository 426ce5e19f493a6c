// What happens to the lanes that an event stops on their march: see kernel-inl.hpp, which includes this.
#if defined(PETERKA_BATCH_EVENTS_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef PETERKA_BATCH_EVENTS_INL_HPP
#undef PETERKA_BATCH_EVENTS_INL_HPP
#else
#define PETERKA_BATCH_EVENTS_INL_HPP
#endif

#include "batch/kernel-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace peterka::batch::HWY_NAMESPACE {

template <bool measure, bool jacobian, bool cubic>
HWY_ATTR void Kernel<measure, jacobian, cubic>::strike_all(int n) {
    while (queues_.crossings.size > 0) {
        const Index lanes = take(queues_.crossings);
        const Cells cells = cells_of(lanes);
        const V time = all(n) * cells.step;
        const Moment start{gather(lanes_.delta[1 - next_], lanes), gather(lanes_.velocity[1 - next_], lanes),
                           all(grid_.sine[static_cast<std::size_t>(n)]),
                           all(grid_.cosine[static_cast<std::size_t>(n)])};
        const Found found = strike(rig_, cells, start, gather(lanes_.delta[next_], lanes),
                                   gather(lanes_.velocity[next_], lanes), gather(lanes_.margin, lanes));
        const Mask which = found.found;
        push(lanes, all(n + 1), time, start, ~which & real_, queues_.hops);
        if (any(which)) {
            Gathered track(lanes_, lanes);
            touch(cells, time + found.time, found.moment, which, track);
            track.keep(lanes_, lanes);
        }
    }
}

template <bool measure, bool jacobian, bool cubic>
HWY_ATTR void Kernel<measure, jacobian, cubic>::drain() {
    // each round carries its lanes on in time; what goes on for longer is left to the twin
    for (int round = 0; round < 100'000; ++round) {
        if (queues_.hops.size > 0) {
            hop();
        } else if (queues_.contacts.size > 0) {
            stay();
        } else if (queues_.releases.size > 0) {
            release_all();
        } else if (queues_.turns.size > 0) {
            turn();
        } else {
            return;
        }
    }
    for (Queue* queue : {&queues_.hops, &queues_.contacts, &queues_.releases, &queues_.turns}) {
        while (queue->size > 0) {
            const Waiting w = take(*queue);
            leave_to_twin(cells_of(w.lanes), every());
        }
    }
}

template <bool measure, bool jacobian, bool cubic>
HWY_ATTR void Kernel<measure, jacobian, cubic>::hop() {
    const Waiting w = take(queues_.hops);
    const Cells cells = cells_of(w.lanes);
    const V length = mul_sub(w.end, cells.step, w.time);
    const Flight flight(rig_, cells, w.moment);
    const V fourth = flight.fourth_derivative_bound(gather(lanes_.swing, w.lanes));
    const Found found = seek_touch(rig_, cells, w.moment, length, fourth, every());
    leave_to_twin(cells, found.unsure);
    const Mask touches = found.found;
    const Mask stays_below = ~(found.unsure | touches);
    if (any(stays_below)) {
        const Moment end = flight.at(length);
        const Mask below = end.delta < all(0);
        arrive(cells, end.delta, end.velocity, w.end, fourth, stays_below & below);
        leave_to_twin(cells, ~below & stays_below);
        if constexpr (cubic && jacobian) {
            Gathered track(lanes_, w.lanes);
            track.carry(flight_flow(rig_, cells, mul_sub(w.end, cells.step, track.leg_start)), stays_below);
            track.keep(lanes_, w.lanes);
        }
    }
    if (any(touches)) {
        Gathered track(lanes_, w.lanes);
        touch(cells, w.time + found.time, found.moment, touches, track);
        track.keep(lanes_, w.lanes);
    }
}

template <bool measure, bool jacobian, bool cubic>
HWY_ATTR void Kernel<measure, jacobian, cubic>::arrive(const Cells& cells, V delta, V velocity, V grid_point,
                                                       V fourth_derivative, Mask which) {
    put(delta, lanes_.delta[next_], cells.index, which);
    put(velocity, lanes_.velocity[next_], cells.index, which);
    put(grid_point, lanes_.next, cells.index, which);
    put(hull_margin(fourth_derivative, cells.step), lanes_.margin, cells.index, which);
}

// The hammer meets the stop.
template <bool measure, bool jacobian, bool cubic>
HWY_ATTR void Kernel<measure, jacobian, cubic>::touch(const Cells& cells, V time, const Moment& m, Mask which,
                                                      Gathered& track) {
    const V drive = cells.drive;
    // a touch so slow that rounding decides about it
    const V scale = drive + abs(cells.gap) + all(1);
    const Mask slow = m.velocity * m.velocity <= all(1e-10) * scale * scale;
    leave_to_twin(cells, which & slow);
    which = ~slow & which;

    track.impacts = choose(which, track.impacts + all(1), track.impacts);
    track.pattern = choose(which, append(track.pattern, trajectory::Phase::contact), track.pattern);
    if constexpr (measure && !cubic) {
        const V duration = time - track.leg_start;
        track.raise_displacement(
            min(track.swing + track.leg_amplitude, mul_add(drive, duration, track.leg_energy)), which);
    }
    if constexpr (jacobian) {
        track.carry(flight_flow(rig_, cells, time - track.leg_start), which);
        track.jump(rig_.damping, which);
    }
    if constexpr (measure || jacobian) track.leg_start = choose(which, time, track.leg_start);

    Mask is_short = none();
    if constexpr (!cubic) is_short = touch_shortly(cells, time, m, which, track);
    push(cells.index, all(0), time, m, real_ & ~is_short & which, queues_.contacts);
}

// Those of the touches that are over soon, and what follows.
template <bool measure, bool jacobian, bool cubic>
HWY_ATTR Mask Kernel<measure, jacobian, cubic>::touch_shortly(const Cells& cells, V time, const Moment& m,
                                                              Mask which, Gathered& track) {
    const V drive = cells.drive;
    const V pull = mul_sub(drive, m.sine, cells.gap);
    const V speed = m.velocity;
    const Mask like_unforced = (pull >= all(rig_.least_pull) * speed) &
                               (pull <= all(rig_.largest_pull) * speed) &
                               (drive * cells.eta <= all(rig_.largest_jerk) * speed);
    const Mask ends_before = time + all(rig_.latest_exit) < all(steps_) * cells.step;
    const Mask small_angle = cells.eta * all(rig_.latest_exit) < all(0.78);  // pi/4, the range of the series
    const Mask may_be_short = like_unforced & ends_before & small_angle;
    Mask is_short = which & may_be_short;
    if (any(is_short)) {
        const Contact contact(rig_, lanes_, cells, m);
        // the pull half-way
        const V later = mul_add(cells.eta * all(rig_.exit_time / 2), m.cosine, m.sine);
        const V mean_pull = mul_sub(drive, later, cells.gap) / m.velocity * all(1 / rig_.pull_scale);
        const V bounded = max(min(mean_pull, all(1)), all(-1));
        const Release end = short_release(rig_, contact, bounded, is_short);
        is_short = is_short & end.sure;
        if constexpr (measure) {
            const Peak peak = short_peak(rig_, contact, bounded, is_short);
            is_short = is_short & peak.sure;
            track.peak_force = choose(is_short, max(track.peak_force, peak.force), track.peak_force);
            const V reach = gather(lanes_.contact_swing, cells.index) + contact.amplitude(contact.start());
            const V energy = sqrt(mul_add(contact.rest(), contact.rest(),
                                          m.velocity * m.velocity * all(1 / rig_.contact_square)));
            const V work = drive * end.time * all(1 / rig_.contact_frequency);
            track.raise_displacement(abs(contact.rest() + cells.gap) + min(reach, energy + work), is_short);
        }
        if constexpr (jacobian) track.carry(contact.flow_for(end.time), is_short);
        track.pattern = choose(is_short, append(track.pattern, trajectory::Phase::unloaded), track.pattern);
        release(cells, time + end.time, let_go(contact.moment(end.point)), is_short, track);
    }
    return is_short;
}

// A contact of any length, from its beginning or from the cycle's.
template <bool measure, bool jacobian, bool cubic>
HWY_ATTR void Kernel<measure, jacobian, cubic>::stay() {
    const Waiting w = take(queues_.contacts);
    const Cells cells = cells_of(w.lanes);
    const Contact contact(rig_, lanes_, cells, w.moment);
    const V length = mul_sub(all(until_), cells.step, w.time);
    const V zero = all(0);
    Sought end = seek(cells, contact, 0, all(-1), zero, contact.start(), length, every());
    Mask sure = ~end.unsure;
    const V duration = choose(end.found, end.time, length);
    Gathered track(lanes_, w.lanes);
    if constexpr (measure) {
        const Peak peak = long_peak(cells, contact, duration, sure);
        sure = sure & peak.sure;
        track.peak_force = choose(sure, max(track.peak_force, peak.force), track.peak_force);
        const V reach = gather(lanes_.contact_swing, cells.index) + contact.amplitude(contact.start());
        const V from_rest = w.moment.delta - contact.rest();
        const V speed = w.moment.velocity / cells.contact_frequency;
        const V energy = sqrt(mul_add(from_rest, from_rest, speed * speed));
        const V work = cells.drive * duration / cells.contact_frequency;
        track.raise_displacement(abs(contact.rest() + cells.gap) + min(reach, energy + work), sure);
    }
    if constexpr (jacobian) track.carry(contact.flow_for(duration), sure);
    leave_to_twin(cells, ~sure);

    const Mask stays = ~end.found & sure;
    if (any(stays)) {
        const Moment last = contact.moment(contact.at(length));
        if constexpr (cubic) {
            hold(cells, last.delta, last.velocity, stays, queues_.held_contacts);
        } else {
            arrive(cells, last.delta, last.velocity, all(steps_), zero, stays);
            if constexpr (measure || jacobian) track.leg_start = choose(stays, all(-1), track.leg_start);
        }
    }
    const Mask leaves = sure & end.found;
    track.pattern = choose(leaves, append(track.pattern, trajectory::Phase::unloaded), track.pattern);
    if (any(leaves)) release(cells, w.time + end.time, let_go(contact.moment(end.point)), leaves, track);
    track.keep(lanes_, w.lanes);
}

template <bool measure, bool jacobian, bool cubic>
HWY_ATTR void Kernel<measure, jacobian, cubic>::release_all() {
    const Waiting w = take(queues_.releases);
    const Cells cells = cells_of(w.lanes);
    Gathered track(lanes_, w.lanes);
    release(cells, w.time, w.moment, every(), track);
    track.keep(lanes_, w.lanes);
}

// The stop doesn't press, and the hammer is on its way out: it leaves, and flies on to a grid point.
template <bool measure, bool jacobian, bool cubic>
HWY_ATTR void Kernel<measure, jacobian, cubic>::release(const Cells& cells, V time, const Moment& m, Mask which,
                                                        Gathered& track) {
    const V zero = all(0);
    const Flight flight(rig_, cells, m);
    const V fourth = flight.fourth_derivative_bound(gather(lanes_.swing, cells.index));
    const Derivatives d = derivatives(rig_, cells, m);

    // With an upper bound of delta'' the parabola says when it is surely out, and that it still goes down then;
    // so does the force, whose slope is kappa delta' + chi delta''.
    const V speed = -m.velocity;
    const V leaving = all(1.5) * m.delta / speed;
    const V bend = mul_add(leaving * all(0.5), fourth, d.third);
    const V most = max(zero, max(d.second, mul_add(leaving, bend, d.second)));
    const Mask out = (m.delta >= zero) & (most * m.delta <= all(0.44) * speed * speed);
    const V speed_out = neg_mul_add(most, leaving, speed);
    const Mask soon = leaving <= all(4) * cells.step;  // stretches of flight are six steps at most
    const Mask sure =
        out & soon & (speed > zero) & (most * all(rig_.damping) < all(rig_.stiffness) * speed_out);
    if constexpr (measure && !cubic) {
        const V u = m.delta + cells.gap;
        track.leg_amplitude = choose(which, flight.amplitude(), track.leg_amplitude);
        track.leg_energy = choose(which, sqrt(mul_add(u, u, speed * speed)), track.leg_energy);
    }
    if constexpr (measure || jacobian) track.leg_start = choose(which, time, track.leg_start);
    push(cells.index, zero, time, m, real_ & ~sure & which, queues_.turns);
    which = which & sure;

    // to the first grid point after it is out
    const V grid_point =
        cubic ? all(until_) : min(floor((time + leaving) * cells.per_step) + all(1), all(steps_));
    const V length = mul_sub(grid_point, cells.step, time);
    const Moment end = flight.at(length);
    const Mask goes_on = length <= leaving;  // the cycle, or with kicks the step, ends before it is out
    const V margin = hull_margin(fourth, length);
    const Hull hull(m.delta, m.velocity, end.delta, end.velocity, length, margin);
    const V top = max(max(hull.b1, hull.b2), max(hull.b3, hull.b4));
    const Mask below = (top < zero) & (hull.scaled_at(leaving, length - leaving) <= zero);
    Mask free = which & (goes_on | below);
    if constexpr (cubic) {
        const Mask held = which & goes_on & (end.delta >= zero);
        hold(cells, end.delta, end.velocity, held, queues_.held_releases);
        if constexpr (measure) {
            track.raise_displacement(hull.displacement_bound(cells.gap, m.delta, margin), which);
        }
        if constexpr (jacobian) track.carry(flight_flow(rig_, cells, length), free);
        arrive(cells, end.delta, end.velocity, grid_point, fourth, free & ~held);
    } else {
        arrive(cells, end.delta, end.velocity, grid_point, fourth, free);
    }
    const Mask flies = which & (~goes_on | (end.delta < zero));
    const V separated = gather(lanes_.separated, cells.index);  // most lanes are since the cycle began
    if (any(flies & (separated == zero))) put(all(1), lanes_.separated, cells.index, flies);

    const Mask may_rise = ~free & which;
    if (any(may_rise))
        push(cells.index, grid_point, time + leaving, flight.at(leaving), real_ & may_rise, queues_.hops);
}

// The stop doesn't press, and the hammer leaves so slowly that it may turn: then contact resumes. Above the
// stop it can't get from below without a force, so where the force rises next tells whether it had left.
template <bool measure, bool jacobian, bool cubic>
HWY_ATTR void Kernel<measure, jacobian, cubic>::turn() {
    const Waiting w = take(queues_.turns);
    const Cells cells = cells_of(w.lanes);
    const Flight flight(rig_, cells, w.moment);
    const V zero = all(0);
    const V fourth = flight.fourth_derivative_bound(gather(lanes_.swing, w.lanes));
    const V grid_point = cubic ? all(until_) : min(floor(w.time * cells.per_step) + all(4), all(steps_));
    const V length = mul_sub(grid_point, cells.step, w.time);
    const Found force = seek_force(rig_, cells, w.moment, length, fourth, every());
    const Mask resumes = force.found & (force.moment.delta > zero);
    const Mask has_left = force.found & (force.moment.delta < zero);
    const Moment end = flight.at(length);
    const Mask quiet = ~(force.found | force.unsure);
    const Mask flies = quiet & (end.delta < zero);
    const Mask held = quiet & (end.delta >= zero) & (grid_point >= all(until_));
    Gathered track(lanes_, w.lanes);
    if constexpr (measure && cubic) {
        const V margin = hull_margin(fourth, length);
        const Hull hull(w.moment.delta, w.moment.velocity, end.delta, end.velocity, length, margin);
        track.raise_displacement(hull.displacement_bound(cells.gap, w.moment.delta, margin), every());
    }

    if constexpr (cubic) {
        if constexpr (jacobian) track.carry(flight_flow(rig_, cells, length), flies | held);
        hold(cells, end.delta, end.velocity, held, queues_.held_releases);
        arrive(cells, end.delta, end.velocity, grid_point, fourth, flies);
    } else {
        arrive(cells, end.delta, end.velocity, grid_point, fourth, flies | held);
    }
    const Mask separates = flies | has_left;
    if (any(separates)) put(all(1), lanes_.separated, cells.index, separates);
    const V time = w.time + force.time;
    push(cells.index, grid_point, time, force.moment, real_ & has_left, queues_.hops);

    if (any(resumes)) {
        if constexpr (measure && !cubic) {
            track.raise_displacement(
                min(track.swing + track.leg_amplitude, mul_add(cells.drive, force.time, track.leg_energy)),
                resumes);
        }
        if constexpr (jacobian) track.carry(flight_flow(rig_, cells, force.time), resumes);
        if constexpr (measure || jacobian) track.leg_start = choose(resumes, time, track.leg_start);
        track.pattern = choose(resumes, append(track.pattern, trajectory::Phase::contact), track.pattern);
        put(all(1), lanes_.touched, cells.index, resumes);
        push(cells.index, zero, time, force.moment, real_ & resumes, queues_.contacts);
    }
    leave_to_twin(cells, ~(resumes | has_left | flies | held));
    track.keep(lanes_, w.lanes);
}

// The hammer is at the stop at the grid point, and waits for the kick there.
template <bool measure, bool jacobian, bool cubic>
HWY_ATTR void Kernel<measure, jacobian, cubic>::hold(const Cells& cells, V delta, V velocity, Mask which,
                                                     Queue& held) {
    if (!any(which)) return;
    const auto point = static_cast<std::size_t>(until_);
    const Moment m{delta, velocity, all(grid_.sine[point]), all(grid_.cosine[point])};
    push(cells.index, all(until_), all(until_) * cells.step, m, real_ & which, held);
    put(all(never), lanes_.next, cells.index, which);
}

// `part` of a whole kick of those at the stop.
template <bool measure, bool jacobian, bool cubic>
HWY_ATTR void Kernel<measure, jacobian, cubic>::kick_held(double part) {
    kick_held(queues_.held_contacts, queues_.contacts, true, part);
    kick_held(queues_.held_releases, queues_.releases, false, part);
}
template <bool measure, bool jacobian, bool cubic>
HWY_ATTR void Kernel<measure, jacobian, cubic>::kick_held(Queue& held, Queue& ready, bool pressed,
                                                          double part) {
    while (held.size > 0) {
        const Waiting w = take(held);
        const Cells cells = cells_of(w.lanes);
        const Kick kick(all(part * rig_.cubic) * cells.step, cells.gap, w.moment.delta);
        const V velocity = w.moment.velocity - kick.speed;
        if constexpr (jacobian) {
            Gathered track(lanes_, w.lanes);
            track.j10 = neg_mul_add(kick.slope, track.j00, track.j10);
            track.j11 = neg_mul_add(kick.slope, track.j01, track.j11);
            track.keep(lanes_, w.lanes);
        }
        // a kick that made the force change its sign would be an event
        const V force = mul_add(all(rig_.stiffness), w.moment.delta, all(rig_.damping) * velocity);
        const Mask presses = force > all(0);
        const Mask same = (w.moment.delta >= all(0)) & (pressed ? presses : ~presses);
        leave_to_twin(cells, ~same);
        const Moment kicked{w.moment.delta, velocity, w.moment.sine, w.moment.cosine};
        push(w.lanes, w.end, w.time, kicked, real_ & same, ready);
    }
}

}  // namespace peterka::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
