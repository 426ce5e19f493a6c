// How the hammer leaves the stop once it no longer presses; included by kernel-inl.hpp.
#if defined(PETERKA_BATCH_DEPARTURES_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef PETERKA_BATCH_DEPARTURES_INL_HPP
#undef PETERKA_BATCH_DEPARTURES_INL_HPP
#else
#define PETERKA_BATCH_DEPARTURES_INL_HPP
#endif

#include "batch/kernel-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace peterka::batch::HWY_NAMESPACE {

template <Law law, bool own>
HWY_ATTR void Kernel<law, own>::release_all() {
    const Waiting w = take(queues_.releases);
    const Cells cells = cells_of(w.lanes);
    Gathered track(lanes_, w.lanes);
    release(cells, w.time, w.moment, w.end, every(), track);
    track.keep(lanes_, w.lanes);
}

// The stop does not press, and the hammer moves out: it leaves, and flies on to a grid point.
template <Law law, bool own>
HWY_ATTR void Kernel<law, own>::release(const Cells& cells, V time, const Moments& m, V until, Mask which,
                                        Gathered& track) {
    const V zero = all(0);
    const Flight flight(cells, m);
    const V fourth = flight.fourth_derivative_bound(gather(lanes_[Field::swing], cells.index));
    const Derivatives d = derivatives(cells, m);

    // With an upper bound of delta'' the parabola tells when the hammer is surely out, and that it still moves
    // down then; so does the force, whose slope is kappa delta' + chi delta''. Without curvature the hammer is
    // out after delta/speed; after 1.5 times as long the parabola delta - speed t + most t^2/2 is below zero if
    // most delta < 4/9 speed^2. A rigid stop is at delta = 0.
    const V speed = -m.velocity;
    const V leaving = rigid ? zero : all(1.5) * m.delta / speed;
    const V bend = mul_add(leaving * all(0.5), fourth, d.third);
    const V most = max(zero, max(d.second, mul_add(leaving, bend, d.second)));
    const Mask out = (m.delta >= zero) & (most * m.delta <= all(0.44) * speed * speed);
    const V speed_out = neg_mul_add(most, leaving, speed);
    const Mask soon = leaving <= all(4) * cells.step;  // stretches of flight are six steps at most
    const Mask sure =
        out & soon & (speed > zero) & (most * all(cells.rig.damping) < all(cells.rig.stiffness) * speed_out);
    begin_leg(cells, time, m, which, track);
    if constexpr (!rigid) {
        push(cells.index, until, time, m, real_ & ~sure & which, queues_.turns);
        which = which & sure;
    }

    // to the first grid point after leaving
    const V grid_point = cubic ? until : min(floor((time + leaving) * cells.per_step) + all(1), all(steps_));
    const V length = mul_sub(grid_point, cells.step, time);
    const Moments end = end_of(flight, length);
    const Mask goes_on = length <= leaving;  // the cycle or, with kicks, the step ends before it is out
    const V margin = hull_margin(fourth, length);
    const Hull hull(m.delta, m.velocity, end.delta, end.velocity, length, margin);
    const V top = max(max(hull.b1, hull.b2), max(hull.b3, hull.b4));
    const Mask below = (top < zero) & (hull.scaled_at(leaving, length - leaving) <= zero);
    Mask free = which & (goes_on | below);
    if constexpr (cubic) {
        const Mask held = which & goes_on & (end.delta >= zero);
        hold(cells, end.delta, end.velocity, until, held, queues_.held_releases);
        track.raise_displacement(hull.displacement_bound(cells.gap, m.delta, margin), which);
        track.carry(flown(cells, length), free);
        arrive(cells, end.delta, end.velocity, grid_point, fourth, free & ~held);
    } else {
        arrive(cells, end.delta, end.velocity, grid_point, fourth, free);
    }
    const Mask flies = which & (~goes_on | (end.delta < zero));
    const V separated = gather(lanes_[Field::separated], cells.index);  // most lanes are since the cycle began
    if (any(flies & (separated == zero))) put(all(1), lanes_[Field::separated], cells.index, flies);

    const Mask may_rise = ~free & which;
    if (any(may_rise)) {
        push(cells.index, grid_point, time + leaving, rigid ? m : flight.at(leaving), real_ & may_rise,
             queues_.hops);
    }
}

// The stop does not press, and the hammer leaves so slowly that it may turn back: then contact resumes. It
// cannot rise from below the stop to above it without a force, so where the force rises next tells whether it
// had left.
template <Law law, bool own>
HWY_ATTR void Kernel<law, own>::turn() {
    const Waiting w = take(queues_.turns);
    const Cells cells = cells_of(w.lanes);
    const Flight flight(cells, w.moment);
    const V zero = all(0);
    const V fourth = flight.fourth_derivative_bound(gather(lanes_[Field::swing], w.lanes));
    const V grid_point = cubic ? w.end : min(floor(w.time * cells.per_step) + all(4), w.end);
    const V length = mul_sub(grid_point, cells.step, w.time);
    const MeetingMoment force = seek_force(cells, w.moment, length, fourth, every());
    const Mask resumes = force.found & (force.moment.delta > zero);
    const Mask has_left = force.found & (force.moment.delta < zero);
    const Moments end = end_of(flight, length);
    const Mask quiet = ~(force.found | force.unsure);
    const Mask flies = quiet & (end.delta < zero);
    const Mask held = quiet & (end.delta >= zero) & (grid_point >= w.end);
    Gathered track(lanes_, w.lanes);
    if constexpr (cubic) {
        const V margin = hull_margin(fourth, length);
        const Hull hull(w.moment.delta, w.moment.velocity, end.delta, end.velocity, length, margin);
        track.raise_displacement(hull.displacement_bound(cells.gap, w.moment.delta, margin), every());
        track.carry(flown(cells, length), flies | held);
        hold(cells, end.delta, end.velocity, w.end, held, queues_.held_releases);
        arrive(cells, end.delta, end.velocity, grid_point, fourth, flies);
    } else {
        arrive(cells, end.delta, end.velocity, grid_point, fourth, flies | held);
    }
    const Mask separates = flies | has_left;
    if (any(separates)) put(all(1), lanes_[Field::separated], cells.index, separates);
    const V time = w.time + force.time;
    push(cells.index, grid_point, time, force.moment, real_ & has_left, queues_.hops);

    if (any(resumes)) {
        if constexpr (!cubic) {
            track.raise_displacement(
                min(track.swing + track.leg_amplitude, mul_add(cells.drive, force.time, track.leg_energy)),
                resumes);
        }
        track.carry(flown(cells, force.time), resumes);
        track.leg_start = choose(resumes, time, track.leg_start);
        track.pattern = choose(resumes, append(track.pattern, trajectory::Phase::contact), track.pattern);
        put(all(1), lanes_[Field::touched], cells.index, resumes);
        push(cells.index, w.end, time, force.moment, real_ & resumes, queues_.contacts);
    }
    leave_to_twin(cells, ~(resumes | has_left | flies | held));
    track.keep(lanes_, w.lanes);
}

}  // namespace peterka::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
