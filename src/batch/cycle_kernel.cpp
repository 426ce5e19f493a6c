// One forcing cycle of many cells at once.
//
// All lanes march together over a grid of forcing phases. A step of free flight is one affine map of (delta,
// delta') per lane; its flag test asks whether the lane can have come above the stop meanwhile (Hull,
// flight-inl.hpp). The few lanes that are flagged are gathered from the whole batch into full vectors, and
// these are carried through entry, contact and release to the grid point after that, where they march on with
// the others:
//
//   step        every lane in flight            -> crossings, hops
//   strike      crossings: above at step's end  -> touch, or hops
//   touch       an impact begins                -> short contact and release, or contacts
//   stay        contacts of any length          -> release, or the cycle's end
//   release     the stop lets go                -> grid point after it, or hops
//   hop         flights that may rise above     -> touch, or nothing happened
//
// Each decision is proved (no event is taken for the first, or for absent, on the strength of samples); where a
// proof fails the lane is left to the scalar twin (trajectory/exact_cycle_map.hpp), which repeats its cycle
// from the start. A lane's numbers never depend on other lanes: loops run on until all lanes of a vector are
// done, and those done keep what they have.
//
// What pays, measured on the eight cells of tests/benchmark/batch_cycles.cpp with AVX-512: events of the whole
// batch together in full vectors; short contacts by Newton's method from guesses (touch 37 -> 11 ns per cycle);
// two vectors at once, which hide each other's latency (a sixth of the time); a tenth by 10 steps per cycle
// instead of 16 where they suffice; a series for weak damping and no blending of full vectors (8 %); flags
// collected as bits (3 %). The number of slots hardly matters from 256 to 2048: many fill the vectors, few stay
// in the cache.

// Besides the compiler's baseline: SSE4, AVX2 and AVX-512 on x86. More would only lengthen the build.
#include <hwy/detect_targets.h>
#undef HWY_DISABLED_TARGETS
#if defined(HWY_AVX3_ZEN4)
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL | HWY_AVX3_ZEN4)
#else
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL)
#endif

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "batch/cycle_kernel.cpp"
#include <hwy/foreach_target.h>
//
#include <algorithm>
#include <bit>

#include "batch/cycle_kernel.hpp"
#include "batch/long_contact-inl.hpp"
#include "batch/meeting-inl.hpp"
#include "batch/queues-inl.hpp"
#include "batch/short_contact-inl.hpp"
#include "batch/track-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace peterka::batch::HWY_NAMESPACE {

template <bool measure, bool jacobian>
class Kernel {
  public:
    Kernel(const Rig& rig, const Grid& grid, const Lanes& lanes, Queues& queues)
        : rig_(rig), grid_(grid), lanes_(lanes), queues_(queues), steps_(grid.steps) {}

    HWY_ATTR void run() {
        begin();
        drain();
        for (int n = 0; n < steps_; ++n) {
            step(n);
            strike_all(n);
            drain();
        }
        finish();
    }

  private:
    using Gathered = Track<measure, jacobian>;

    HWY_ATTR void begin();
    HWY_ATTR void step(int n);
    HWY_ATTR void strike_all(int n);
    HWY_ATTR void drain();
    HWY_ATTR void hop();
    HWY_ATTR void stay();
    HWY_ATTR void release_all();
    HWY_ATTR void touch(const Cells& cells, V time, const Moment& m, Mask which, Gathered& track);
    HWY_ATTR void release(const Cells& cells, V time, const Moment& m, Mask which, Gathered& track);
    HWY_ATTR void finish();

    // Takes lanes off a list; from then on `real_` says which of them are no padding.
    HWY_ATTR Index take(Crossings& list) {
        const Taken taken = batch::HWY_NAMESPACE::take(list);
        real_ = taken.real;
        return taken.lanes;
    }
    HWY_ATTR Waiting take(Queue& queue) {
        const Waiting waiting = batch::HWY_NAMESPACE::take(queue);
        real_ = waiting.real;
        return waiting;
    }
    // An elastic stop lets go at delta = 0, give or take a rounding error.
    HWY_ATTR static Moment let_go(const Moment& m) {
        return {max(m.delta, all(0)), m.velocity, m.sine, m.cosine};
    }
    HWY_ATTR void leave_to_twin(const Cells& cells, Mask which) {
        if (!any(which)) return;
        push(cells.index, which & real_, queues_.twin);
        put(all(never), lanes_.next, cells.index, which);
    }
    HWY_ATTR static void put(V x, double* to, Index lanes, Mask which) {
        scatter(everywhere(which) ? x : choose(which, x, gather(to, lanes)), to, lanes);
    }
    HWY_ATTR void arrive(const Cells& cells, V delta, V velocity, V grid_point, V fourth_derivative,
                         Mask which);

    const Rig& rig_;
    const Grid& grid_;
    const Lanes& lanes_;
    Queues& queues_;
    double steps_;
    Mask real_ = every();   // of the vector of lanes in hand: not padding
    std::size_t next_ = 0;  // which of the two states is that of the coming grid point
};

// All lanes at forcing phase 0, sorted by phase.
template <bool measure, bool jacobian>
HWY_ATTR void Kernel<measure, jacobian>::begin() {
    const V zero = all(0);
    queues_.twin.size = 0;
    next_ = 0;
    real_ = every();
    for (std::size_t i = 0; i < lanes_.size; i += width()) {
        const Index index = index_from(i);
        const V delta = load(lanes_.delta[0] + i);
        const V velocity = load(lanes_.velocity[0] + i);
        store(delta, lanes_.start_delta + i);
        store(velocity, lanes_.start_velocity + i);

        const V force = mul_add(all(rig_.stiffness), delta, all(rig_.damping) * velocity);
        const Mask at_stop = delta == zero;
        const Mask flight = (delta < zero) | (at_stop & (velocity <= zero));
        const Mask contact = ~flight & ((force > zero) | at_stop);
        const Mask rest = ~(flight | contact);
        const Mask in_use = load(lanes_.in_use + i) > zero;

        const V gap = load(lanes_.gap + i);
        const V eta = load(lanes_.frequency + i);
        const V x = delta + gap - load(lanes_.flight_im + i);
        const V v = neg_mul_add(eta, load(lanes_.flight_re + i), velocity);
        const V quadrature = mul_add(all(rig_.damping_ratio), x, v) * all(1 / rig_.flight_rate);
        const V amplitude = sqrt(mul_add(x, x, quadrature * quadrature));
        const V square = eta * eta;
        const V fourth = mul_add(square * square, load(lanes_.swing + i), amplitude);
        store(hull_margin(fourth, load(lanes_.step + i)), lanes_.margin + i);
        store(choose(flight, zero, all(never)), lanes_.next + i);

        const auto phase = choose(
            flight, patterns(trajectory::Phase::flight),
            choose(contact, patterns(trajectory::Phase::contact), patterns(trajectory::Phase::unloaded)));
        store(phase, lanes_.pattern + i);
        store(zero, lanes_.impacts + i);
        store(choose(contact, all(1), zero), lanes_.touched + i);
        store(choose(flight, all(1), zero), lanes_.separated + i);
        if constexpr (measure) {
            const V u = delta + gap;
            store(zero, lanes_.peak_force + i);
            store(zero, lanes_.largest_displacement + i);
            store(amplitude, lanes_.leg_amplitude + i);
            store(sqrt(mul_add(u, u, velocity * velocity)), lanes_.leg_energy + i);
        }
        if constexpr (measure || jacobian) store(zero, lanes_.leg_start + i);
        if constexpr (jacobian) {
            for (const std::size_t n : {0U, 1U, 2U, 3U}) store(all(n % 3 == 0 ? 1 : 0), lanes_.jacobian[n] + i);
        }
        const Moment start{delta, velocity, zero, all(1)};
        push(index, zero, zero, start, in_use & contact, queues_.contacts);
        push(index, zero, zero, start, in_use & rest, queues_.releases);
        // idle lanes, and numbers that are none
        const Mask idle = ~in_use;
        if (any(idle)) store(choose(idle, all(never), load(lanes_.next + i)), lanes_.next + i);
        const Mask finite = abs(amplitude) < all(1e100);
        const Mask wild = ~finite & in_use;
        if (any(wild)) {
            push(index, wild, queues_.twin);
            store(choose(wild, all(never), load(lanes_.next + i)), lanes_.next + i);
        }
    }
}

// From grid point n to the next.
template <bool measure, bool jacobian>
HWY_ATTR void Kernel<measure, jacobian>::step(int n) {
    const std::size_t now = next_;
    next_ = 1 - now;
    real_ = every();
    const double* HWY_RESTRICT delta = lanes_.delta[now];
    const double* HWY_RESTRICT velocity = lanes_.velocity[now];
    double* HWY_RESTRICT next_delta = lanes_.delta[next_];
    double* HWY_RESTRICT next_velocity = lanes_.velocity[next_];
    const V sine = all(grid_.sine[static_cast<std::size_t>(n)]);
    const V cosine = all(grid_.cosine[static_cast<std::size_t>(n)]);
    const V here = all(n);
    const Lanes lanes = lanes_;  // so that the compiler knows that no store changes them
    for (std::size_t word = 0; word < lanes.size; word += 64) {
        std::uint64_t rises = 0;  // a bit per lane: above the stop at the step's end; or perhaps in between
        std::uint64_t hops = 0;
        for (std::size_t i = word; i < std::min(word + 64, lanes.size); i += width()) {
            const V x0 = load(delta + i);
            const V v0 = load(velocity + i);
            const V c = load(lanes.flow_cosine + i);
            const V s = load(lanes.flow_sine + i);
            const V slope = load(lanes.flow_slope + i);
            const V push_by = mul_add(load(lanes.push_sine + i), sine,
                                      mul_add(load(lanes.push_cosine + i), cosine, load(lanes.push_rest + i)));
            const V kick_by = mul_add(load(lanes.kick_sine + i), sine,
                                      mul_add(load(lanes.kick_cosine + i), cosine, load(lanes.kick_rest + i)));
            const V x1 = mul_add(c, x0, mul_add(s, v0, push_by));
            const V v1 = neg_mul_add(s, x0, mul_add(slope, v0, kick_by));
            const Hull hull(x0, v0, x1, v1, load(lanes.step + i), load(lanes.margin + i));
            const Mask active = load(lanes.next + i) <= here;
            const Mask above = active & (x1 > all(0));
            const Mask between = active & (max(max(hull.b1, hull.b2), hull.b3) > all(0));
            store(choose(active, x1, x0), next_delta + i);
            store(choose(active, v1, v0), next_velocity + i);
            rises |= bits(above) << (i - word);
            hops |= bits(between & ~above) << (i - word);
        }
        for (; rises != 0; rises &= rises - 1) {
            const auto bit = static_cast<std::size_t>(std::countr_zero(rises));
            queues_.crossings.lane[queues_.crossings.size++] = static_cast<std::int64_t>(word + bit);
        }
        for (; hops != 0; hops &= hops - 1) {
            const std::size_t lane = word + static_cast<std::size_t>(std::countr_zero(hops));
            const auto point = static_cast<std::size_t>(n);
            queues_.hops.add(lane, {n + 1.0, n * lanes.step[lane], delta[lane], velocity[lane],
                                    grid_.sine[point], grid_.cosine[point]});
        }
    }
}

template <bool measure, bool jacobian>
HWY_ATTR void Kernel<measure, jacobian>::strike_all(int n) {
    while (queues_.crossings.size > 0) {
        const Index lanes = take(queues_.crossings);
        const Cells cells(lanes_, steps_, lanes);
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

template <bool measure, bool jacobian>
HWY_ATTR void Kernel<measure, jacobian>::drain() {
    // each round carries its lanes on in time; what goes on for longer is left to the twin
    for (int round = 0; round < 100'000; ++round) {
        if (queues_.hops.size > 0) {
            hop();
        } else if (queues_.contacts.size > 0) {
            stay();
        } else if (queues_.releases.size > 0) {
            release_all();
        } else {
            return;
        }
    }
    for (Queue* queue : {&queues_.hops, &queues_.contacts, &queues_.releases}) {
        while (queue->size > 0) {
            const Waiting w = take(*queue);
            leave_to_twin(Cells(lanes_, steps_, w.lanes), every());
        }
    }
}

template <bool measure, bool jacobian>
HWY_ATTR void Kernel<measure, jacobian>::hop() {
    const Waiting w = take(queues_.hops);
    const Cells cells(lanes_, steps_, w.lanes);
    const V length = mul_sub(w.end, cells.step, w.time);
    const Flight flight(rig_, cells, w.moment);
    const V fourth =
        mul_add(cells.drive * cells.drive, gather(lanes_.swing, w.lanes), flight.amplitude_bound());
    const Found found = seek(rig_, cells, w.moment, length, fourth, every());
    leave_to_twin(cells, found.unsure);
    const Mask touches = found.found;
    const Mask stays_below = ~(found.unsure | touches);
    if (any(stays_below)) {
        const Moment end = flight.at(length);
        const Mask below = end.delta < all(0);
        arrive(cells, end.delta, end.velocity, w.end, fourth, stays_below & below);
        leave_to_twin(cells, ~below & stays_below);
    }
    if (any(touches)) {
        Gathered track(lanes_, w.lanes);
        touch(cells, w.time + found.time, found.moment, touches, track);
        track.keep(lanes_, w.lanes);
    }
}

template <bool measure, bool jacobian>
HWY_ATTR void Kernel<measure, jacobian>::arrive(const Cells& cells, V delta, V velocity, V grid_point,
                                                V fourth_derivative, Mask which) {
    put(delta, lanes_.delta[next_], cells.index, which);
    put(velocity, lanes_.velocity[next_], cells.index, which);
    put(grid_point, lanes_.next, cells.index, which);
    put(hull_margin(fourth_derivative, cells.step), lanes_.margin, cells.index, which);
}

// The hammer meets the stop.
template <bool measure, bool jacobian>
HWY_ATTR void Kernel<measure, jacobian>::touch(const Cells& cells, V time, const Moment& m, Mask which,
                                               Gathered& track) {
    const V drive = cells.drive;
    // a touch so slow that rounding decides about it
    const V scale = drive + abs(cells.gap) + all(1);
    const Mask slow = m.velocity * m.velocity <= all(1e-10) * scale * scale;
    leave_to_twin(cells, which & slow);
    which = ~slow & which;

    track.impacts = choose(which, track.impacts + all(1), track.impacts);
    track.pattern = choose(which, append(track.pattern, trajectory::Phase::contact), track.pattern);
    if constexpr (measure) {
        const V duration = time - track.leg_start;
        track.raise_displacement(
            min(track.swing + track.leg_amplitude, mul_add(drive, duration, track.leg_energy)), which);
    }
    if constexpr (jacobian) {
        const V duration = time - track.leg_start;
        const FlowOf f =
            flow(sine_cosine(all(rig_.flight_rate) * duration), exp_of(all(-rig_.damping_ratio) * duration),
                 rig_.damping_ratio, 1, rig_.flight_rate);
        track.carry(f, which);
        track.jump(rig_.damping, which);
    }
    if constexpr (measure || jacobian) track.leg_start = choose(which, time, track.leg_start);

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
    push(cells.index, all(0), time, m, real_ & ~is_short & which, queues_.contacts);
}

// A contact of any length, from its beginning or from the cycle's.
template <bool measure, bool jacobian>
HWY_ATTR void Kernel<measure, jacobian>::stay() {
    const Waiting w = take(queues_.contacts);
    const Cells cells(lanes_, steps_, w.lanes);
    const Contact contact(rig_, lanes_, cells, w.moment);
    const V length = mul_sub(all(steps_), cells.step, w.time);
    const V zero = all(0);
    Sought end = seek(rig_, cells, contact, 0, all(-1), zero, contact.start(), length, every());
    Mask sure = ~end.unsure;
    const V duration = choose(end.found, end.time, length);
    Gathered track(lanes_, w.lanes);
    if constexpr (measure) {
        const Peak peak = long_peak(rig_, cells, contact, duration, sure);
        sure = sure & peak.sure;
        track.peak_force = choose(sure, max(track.peak_force, peak.force), track.peak_force);
        const V reach = gather(lanes_.contact_swing, cells.index) + contact.amplitude(contact.start());
        const V from_rest = w.moment.delta - contact.rest();
        const V energy = sqrt(mul_add(from_rest, from_rest,
                                      w.moment.velocity * w.moment.velocity * all(1 / rig_.contact_square)));
        const V work = cells.drive * duration * all(1 / rig_.contact_frequency);
        track.raise_displacement(abs(contact.rest() + cells.gap) + min(reach, energy + work), sure);
    }
    if constexpr (jacobian) track.carry(contact.flow_for(duration), sure);
    leave_to_twin(cells, ~sure);

    const Mask stays = ~end.found & sure;
    if (any(stays)) {
        const Moment last = contact.moment(contact.at(length));
        arrive(cells, last.delta, last.velocity, all(steps_), zero, stays);
        if constexpr (measure || jacobian) track.leg_start = choose(stays, all(-1), track.leg_start);
    }
    const Mask leaves = sure & end.found;
    track.pattern = choose(leaves, append(track.pattern, trajectory::Phase::unloaded), track.pattern);
    if (any(leaves)) release(cells, w.time + end.time, let_go(contact.moment(end.point)), leaves, track);
    track.keep(lanes_, w.lanes);
}

template <bool measure, bool jacobian>
HWY_ATTR void Kernel<measure, jacobian>::release_all() {
    const Waiting w = take(queues_.releases);
    const Cells cells(lanes_, steps_, w.lanes);
    Gathered track(lanes_, w.lanes);
    release(cells, w.time, w.moment, every(), track);
    track.keep(lanes_, w.lanes);
}

// The stop doesn't press, and the hammer is on its way out: it leaves, and flies on to a grid point.
template <bool measure, bool jacobian>
HWY_ATTR void Kernel<measure, jacobian>::release(const Cells& cells, V time, const Moment& m, Mask which,
                                                 Gathered& track) {
    const V zero = all(0);
    const Flight flight(rig_, cells, m);
    const V fourth =
        mul_add(cells.drive * cells.drive, gather(lanes_.swing, cells.index), flight.amplitude_bound());
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
    leave_to_twin(cells, ~sure & which);
    which = which & sure;
    if constexpr (measure) {
        const V u = m.delta + cells.gap;
        track.leg_amplitude = choose(which, flight.amplitude(), track.leg_amplitude);
        track.leg_energy = choose(which, sqrt(mul_add(u, u, speed * speed)), track.leg_energy);
    }
    if constexpr (measure || jacobian) track.leg_start = choose(which, time, track.leg_start);

    // to the first grid point after it is out
    const V grid_point = min(floor((time + leaving) * cells.per_step) + all(1), all(steps_));
    const V length = mul_sub(grid_point, cells.step, time);
    const Moment end = flight.at(length);
    const Mask goes_on = length <= leaving;  // the cycle ends before it is out
    const Hull hull(m.delta, m.velocity, end.delta, end.velocity, length, hull_margin(fourth, length));
    const V top = max(max(hull.b1, hull.b2), max(hull.b3, hull.b4));
    const Mask below = (top < zero) & (hull.scaled_at(leaving, length - leaving) <= zero);
    const Mask free = which & (goes_on | below);
    arrive(cells, end.delta, end.velocity, grid_point, fourth, free);
    const Mask flies = which & (~goes_on | (end.delta < zero));
    const V separated = gather(lanes_.separated, cells.index);  // most lanes are since the cycle began
    if (any(flies & (separated == zero))) put(all(1), lanes_.separated, cells.index, flies);

    const Mask may_rise = ~free & which;
    if (any(may_rise))
        push(cells.index, grid_point, time + leaving, flight.at(leaving), real_ & may_rise, queues_.hops);
}

// Closes the last leg of each lane.
template <bool measure, bool jacobian>
HWY_ATTR void Kernel<measure, jacobian>::finish() {
    const V zero = all(0);
    for (std::size_t i = 0; i < lanes_.size; i += width()) {
        const V impacts = load(lanes_.impacts + i);
        store(choose(impacts > zero, all(1), load(lanes_.touched + i)), lanes_.touched + i);
        if constexpr (measure || jacobian) {
            const V start = load(lanes_.leg_start + i);
            const Mask flies = start >= zero;
            const V duration = mul_sub(all(steps_), load(lanes_.step + i), start);
            if constexpr (measure) {
                const V eta = load(lanes_.frequency + i);
                const V bound = min(load(lanes_.swing + i) + load(lanes_.leg_amplitude + i),
                                    mul_add(eta * eta, duration, load(lanes_.leg_energy + i)));
                const V largest = load(lanes_.largest_displacement + i);
                store(choose(flies, max(largest, bound), largest), lanes_.largest_displacement + i);
            }
            if constexpr (jacobian) {
                const FlowOf f =
                    flow(sine_cosine(all(rig_.flight_rate) * duration),
                         exp_of(all(-rig_.damping_ratio) * duration), rig_.damping_ratio, 1, rig_.flight_rate);
                const V j00 = load(lanes_.jacobian[0] + i);
                const V j01 = load(lanes_.jacobian[1] + i);
                const V j10 = load(lanes_.jacobian[2] + i);
                const V j11 = load(lanes_.jacobian[3] + i);
                store(choose(flies, f.position(j00, j10), j00), lanes_.jacobian[0] + i);
                store(choose(flies, f.position(j01, j11), j01), lanes_.jacobian[1] + i);
                store(choose(flies, f.velocity(j00, j10), j10), lanes_.jacobian[2] + i);
                store(choose(flies, f.velocity(j01, j11), j11), lanes_.jacobian[3] + i);
            }
        }
    }
}

HWY_ATTR void run(const Rig& rig, const Grid& grid, const Lanes& lanes, Queues& queues, Wanted wanted) {
    if (wanted.measure && wanted.jacobian) return Kernel<true, true>(rig, grid, lanes, queues).run();
    if (wanted.measure) return Kernel<true, false>(rig, grid, lanes, queues).run();
    if (wanted.jacobian) return Kernel<false, true>(rig, grid, lanes, queues).run();
    return Kernel<false, false>(rig, grid, lanes, queues).run();
}

const char* arithmetic_name() {
#if HWY_NATIVE_FMA
    return "fma";
#else
    return "plain";
#endif
}

}  // namespace peterka::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace peterka::batch {

HWY_EXPORT(run);
HWY_EXPORT(arithmetic_name);

void run_cycle(const Rig& rig, const Grid& grid, const Lanes& lanes, Queues& queues, Wanted wanted) {
    HWY_DYNAMIC_DISPATCH(run)(rig, grid, lanes, queues, wanted);
}

std::string_view arithmetic() {
    return HWY_DYNAMIC_DISPATCH(arithmetic_name)();
}

std::vector<std::int64_t> instruction_sets() {
    return hwy::SupportedAndGeneratedTargets();
}

std::string_view name_of(std::int64_t instruction_set) {
    return hwy::TargetName(instruction_set);
}

void use_instruction_set(std::int64_t instruction_set) {
    hwy::GetChosenTarget().Update(instruction_set != 0 ? instruction_set : hwy::SupportedTargets());
}

}  // namespace peterka::batch
#endif
