// Impacts, chatter and rest of lanes that strike a rigid stop; included by kernel-inl.hpp.
// trajectory/rigid_stop.hpp and rigid_impact.hpp explain the mechanics.
#if defined(PETERKA_BATCH_RIGID_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef PETERKA_BATCH_RIGID_INL_HPP
#undef PETERKA_BATCH_RIGID_INL_HPP
#else
#define PETERKA_BATCH_RIGID_INL_HPP
#endif

#include <array>
#include <numbers>

#include "batch/kernel-inl.hpp"
#include "trajectory/rigid_impact.hpp"

HWY_BEFORE_NAMESPACE();
namespace peterka::batch::HWY_NAMESPACE {

// A flight that leaves the stop and returns soon, by its Taylor series delta = sum of c_n t^n: t is the root of
// delta/t, whose slope keeps its sign all the way.
struct ShortHop {
    V time, speed;  // time and speed of the return
    Mask sure;
};
HWY_INLINE ShortHop short_hop(const auto& cells, const Moments& start, V fourth_derivative, V left) {
    // At a quarter of a radian the truncation error is 1e-18 of the forcing's part.
    constexpr std::size_t terms = 13;
    constexpr double longest = 0.25;
    const V zeta = all(cells.rig.damping_ratio);
    std::array<V, terms + 1> c;
    c[0] = all(0);
    c[1] = start.velocity;
    V wave = cells.drive * start.sine;
    V next_wave = cells.drive * cells.eta * start.cosine;
    V force = wave + cells.static_position;
    for (std::size_t n = 0; n + 2 <= terms; ++n) {
        const auto order = static_cast<double>(n);
        const double inverse = 1 / ((order + 1) * (order + 2));
        const V loss = neg_mul_add(all(2 * (order + 1)) * zeta, c[n + 1], force - c[n]);
        c[n + 2] = all(inverse) * loss;
        const V after = all(-inverse) * cells.drive * wave;
        wave = next_wave;
        next_wave = after;
        force = wave;
    }
    const V root = sqrt(max(neg_mul_add(all(4) * c[3], c[1], c[2] * c[2]), all(0)));
    V time = all(-2) * c[1] / (c[2] + root);
    V slope = all(0);
    V step = all(0);
    for (int n = 0; n < 5; ++n) {
        V value = c[terms];
        slope = all(0);
        for (std::size_t k = terms - 1; k > 0; --k) {
            slope = mul_add(slope, time, value);
            value = mul_add(value, time, c[k]);
        }
        step = -value / slope;
        time = time + step;
    }
    const Mask converged = abs(step) <= all(1e-14) * time;
    const Mask is_short = (time > all(0)) & (time * max(cells.eta, all(1)) <= all(longest)) & (time < left);
    const V bend = mul_add(fourth_derivative * time, time * all(0.125), all(2) * abs(c[3]) * time);
    return {time, time * slope, converged & is_short & (c[2] > bend)};
}

// Integral of the acceleration at rest on the stop over the time from one phase to another.
HWY_INLINE V pressing_impulse(const auto& cells, V from, V to) {
    const V half_way = (to - from) * all(0.5);
    const V wave = all(2) * sine_cosine(from + half_way).sine * sine_cosine(half_way).sine;
    return mul_add(cells.drive, wave, all(2) * cells.static_position * half_way) / cells.eta;
}

// The result of an impact at a speed v > 0.
template <Law law, bool own>
struct Kernel<law, own>::Struck {
    V rebound;   // the speed after it
    Mask rests;  // the chatter ends with it: these lanes wait at rest
};

template <Law law, bool own>
HWY_ATTR typename Kernel<law, own>::Struck Kernel<law, own>::strike_rigid(const Cells& cells, V time,
                                                                          const Moments& m, Mask which,
                                                                          Gathered& track) {
    const V r = all(cells.rig.restitution);
    const V theta = cells.eta * time;
    const V pull = mul_sub(cells.drive, m.sine, cells.gap);  // a at rest on the stop
    const V rebound = r * m.velocity;
    const V press_to = gather(lanes_[Field::press_to], cells.index);
    const Mask pressed =
        which & (r < all(1)) & presses(gather(lanes_[Field::press_from], cells.index), press_to, theta);
    const Mask begins = pressed & (theta >= gather(lanes_[Field::chain_until], cells.index));
    if (any(begins)) {
        put(choose(theta <= press_to, press_to, all(never)), lanes_[Field::chain_until], cells.index, begins);
        put(track.impacts, lanes_[Field::chain_impacts], cells.index, begins);
        scatter(choose(begins, track.pattern, gather(lanes_.chain_pattern, cells.index)), lanes_.chain_pattern,
                cells.index);
    }
    const V impulse = (all(1) + r) * m.velocity;
    track.impact_speed = choose(which, max(track.impact_speed, m.velocity), track.impact_speed);
    track.impulse = choose(which, max(track.impulse, impulse), track.impulse);
    const V work = (all(1) - r) * impulse * m.velocity * all(0.5);
    track.contact_work = choose(which, track.contact_work + work, track.contact_work);
    if (any(pressed)) {
        const V before = choose(begins, all(0), gather(lanes_[Field::chain_impulse], cells.index));
        put(before + impulse, lanes_[Field::chain_impulse], cells.index, pressed);
    }
    track.impacts = choose(which, track.impacts + all(1), track.impacts);
    track.pattern = choose(which, append(track.pattern, trajectory::Phase::contact), track.pattern);
    track.reflect(r, (all(1) + r) * pull / m.velocity, which);

    // the series of the remaining bounces
    constexpr double small = 6.0554544523933429e-6 / 8;  // cube root of a double's epsilon
    const V sigma = rebound / (pull * (all(1) - r));
    const V slope = cells.eta * cells.drive * m.cosine / pull;
    const V rate =
        all(1) + all(cells.rig.damping_ratio) + cells.eta + abs(slope) + sqrt(cells.drive * cells.drive / pull);
    const Mask at_once = rebound == all(0);
    const Mask rests = pressed & (at_once | ((pull > all(0)) & (sigma * rate < all(small))));
    if (any(rests)) {
        const V series = all(2.0 / 3) * (all(cells.rig.damping_ratio) + slope);
        const V last = all(2) * sigma * neg_mul_add(sigma, series, all(1));
        const Pattern before = gather(lanes_.chain_pattern, cells.index);
        track.pattern = choose(rests, append(before, trajectory::chatter_event), track.pattern);
        const V chained = track.impacts - gather(lanes_[Field::chain_impacts], cells.index);
        put(gather(lanes_[Field::swallowed], cells.index) + chained - all(1), lanes_[Field::swallowed],
            cells.index, rests);
        put(all(1), lanes_[Field::chatter], cells.index, rests & ~at_once);
        // the remaining bounces absorb the remaining speed; the stop presses until the release
        const V left = rebound * rebound * all(0.5);
        track.contact_work = choose(rests, track.contact_work + left, track.contact_work);
        put(gather(lanes_[Field::chain_impulse], cells.index) - rebound, lanes_[Field::chain_impulse],
            cells.index, rests);
        put(theta, lanes_[Field::chain_until], cells.index, rests);
        push(cells.index, all(steps_), time + choose(at_once, all(0), last), m, real_ & rests,
             queues_.contacts);
    }
    return {rebound, rests};
}

// After an impact: at rest, soon back, or on the way to a grid point.
template <Law law, bool own>
HWY_ATTR void Kernel<law, own>::rebound(const Cells& cells, V time, const Moments& m, Mask which,
                                        Gathered& track) {
    const Struck after = strike_rigid(cells, time, m, which, track);
    const Moments left{all(0), -after.rebound, m.sine, m.cosine};
    const V pull = mul_sub(cells.drive, m.sine, cells.gap);
    const Mask goes = which & ~after.rests;
    const Mask soon = goes & (after.rebound > all(0)) &
                      (all(8) * after.rebound * max(cells.eta, all(1)) < pull);  // in a quarter of a radian
    if (any(soon)) {
        begin_leg(cells, time, left, soon, track);
        push(cells.index, all(steps_), time, left, real_ & soon, queues_.turns);
    }
    depart(cells, time, left, goes & ~soon, track);
}

// Bounces of a chatter, one after another, until it comes to rest or a flight takes longer.
template <Law law, bool own>
HWY_ATTR void Kernel<law, own>::bounce() {
    constexpr double most_impacts = 9'990;  // beyond, the twin decides whether these are too many for a cycle
    const Waiting w = take(queues_.turns);
    const Cells cells = cells_of(w.lanes);
    const V swing = gather(lanes_[Field::swing], w.lanes);
    Gathered track(lanes_, w.lanes);
    V time = w.time;
    Moments m = w.moment;
    Mask active = every();
    while (any(active)) {
        const V fourth = Flight(cells, m).fourth_derivative_bound(swing);
        const ShortHop hop = short_hop(cells, m, fourth, mul_sub(all(steps_), cells.step, time));
        const Mask leaves = active & ~hop.sure;
        if (any(leaves)) depart(cells, time, m, leaves, track);
        active = active & hop.sure;
        if (!any(active)) break;
        end_leg(cells, hop.time, soon_flow(cells, hop.time), active, track);
        time = choose(active, time + hop.time, time);
        const SineCosine phase = sine_cosine(cells.eta * time);
        const Moments hit{all(0), hop.speed, phase.sine, phase.cosine};
        const Struck after = strike_rigid(cells, time, hit, active, track);
        const Mask endless = active & (track.impacts > all(most_impacts));
        leave_to_twin(cells, endless & ~after.rests);
        active = active & ~(after.rests | endless);
        m = choose(active, Moments{all(0), -after.rebound, phase.sine, phase.cosine}, m);
        begin_leg(cells, time, m, active, track);
    }
    track.keep(lanes_, w.lanes);
}

// The hammer leaves the stop, and is not soon back.
template <Law law, bool own>
HWY_ATTR void Kernel<law, own>::depart(const Cells& cells, V time, const Moments& m, Mask which,
                                       Gathered& track) {
    const Mask at_rest = which & (m.velocity == all(0));
    if (any(at_rest)) fall(cells, time, m, at_rest, track);
    const Mask flies = which & ~at_rest;
    if (any(flies)) release(cells, time, m, all(steps_), flies, track);
}

// A hammer at rest on the stop, until the stop no longer presses it.
template <Law law, bool own>
HWY_ATTR void Kernel<law, own>::rest() {
    const Waiting w = take(queues_.contacts);
    const Cells cells = cells_of(w.lanes);
    Gathered track(lanes_, w.lanes);
    const V zero = all(0);
    const V theta = cells.eta * w.time;
    const V press_to = gather(lanes_[Field::press_to], w.lanes);
    const Mask pressed = presses(gather(lanes_[Field::press_from], w.lanes), press_to, theta);
    const V release_time = choose(theta <= press_to, press_to / cells.eta, all(never));
    const V release_or_now = choose(pressed, release_time, w.time);
    const V end = all(steps_) * cells.step;
    const Mask leaves = release_or_now < end;
    const V until = choose(leaves, release_or_now, end);
    const V theta_until = cells.eta * until;
    const SineCosine phase = sine_cosine(theta_until);
    constexpr double quarter = std::numbers::pi / 2;  // where the sine is largest
    const Mask over_top = (theta <= all(quarter)) & (theta_until >= all(quarter));
    const V first = sine_cosine(theta).sine;
    const V largest = choose(over_top, all(1), max(first, phase.sine));
    const V force = mul_sub(cells.drive, largest, cells.gap);
    track.peak_force = choose(until > w.time, max(track.peak_force, force), track.peak_force);
    track.raise_displacement(abs(cells.gap), every());
    // the chatter and the rest that follows it count as one impact, since the last bounce that was followed
    const V chained = gather(lanes_[Field::chain_impulse], w.lanes) +
                      pressing_impulse(cells, gather(lanes_[Field::chain_until], w.lanes), theta_until);
    track.impulse = choose(leaves, max(track.impulse, chained), track.impulse);
    const V longest = max(gather(lanes_[Field::contact_time], w.lanes), until - w.time);
    put(longest, lanes_[Field::contact_time], w.lanes, leaves);
    track.forget(every());
    put(all(1), lanes_[Field::touched], w.lanes, every());
    arrive(cells, zero, zero, all(steps_), zero, ~leaves);
    track.leg_start = choose(leaves, track.leg_start, all(-1));
    if (any(leaves)) fall(cells, until, {zero, zero, phase.sine, phase.cosine}, leaves, track);
    track.keep(lanes_, w.lanes);
}

// A hammer at rest falls away: it cannot return before half its own period has passed, nor before the stop
// presses again (trajectory/rigid_legs.hpp).
template <Law law, bool own>
HWY_ATTR void Kernel<law, own>::fall(const Cells& cells, V time, const Moments& m, Mask which,
                                     Gathered& track) {
    constexpr double turn = 2 * std::numbers::pi;
    const V theta = cells.eta * time;
    const V press_from = gather(lanes_[Field::press_from], cells.index);
    const V pressing = choose(press_from > theta, press_from, press_from + all(turn));
    const V away = min(all(std::numbers::pi), (pressing - theta) / cells.eta);
    const Flight flight(cells, m);
    const V fourth = flight.fourth_derivative_bound(gather(lanes_[Field::swing], cells.index));
    begin_leg(cells, time, m, which, track);
    put(all(1), lanes_[Field::separated], cells.index, which);

    const V grid_point = min(floor((time + away) * cells.per_step), all(steps_));
    const V length = mul_sub(grid_point, cells.step, time);
    const Mask reaches = length > all(0);
    const Moments there = flight.at(choose(reaches, length, away));
    const Mask below = there.delta < all(0);
    arrive(cells, there.delta, there.velocity, grid_point, fourth, which & reaches & below);
    push(cells.index, grid_point + all(1), time + away, there, real_ & which & ~reaches & below, queues_.hops);
    leave_to_twin(cells, which & ~below);
}

}  // namespace peterka::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
