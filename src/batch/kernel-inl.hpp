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
//   release     the stop lets go                -> grid point after it, hops, or turns
//   turn        it leaves slowly                -> contacts again, grid point, or hops
//   hop         flights that may rise above     -> touch, or nothing happened
//
// With a cubic spring (`cubic`; see trajectory/split_cycle_map.hpp) each grid point brings a kick, and events
// are followed to the next grid point only: a lane at the stop then is held there, and goes on after its kick,
// as a contact of any length. The linear equations are each lane's own.
//
// Each decision is proved (no event is taken for the first, or for absent, on the strength of samples); where a
// proof fails the lane is left to the scalar twin (trajectory/exact_cycle_map.hpp or split_cycle_map.hpp),
// which repeats its cycle from the start. A lane's numbers never depend on other lanes: loops run on until all
// lanes of a vector are done, and those done keep what they have.
//
// What pays, measured on the eight cells of tests/benchmark/batch_cycles.cpp with AVX-512: events of the whole
// batch together in full vectors; short contacts by Newton's method from guesses (touch 37 -> 11 ns per cycle);
// two vectors at once, which hide each other's latency (a sixth of the time); a tenth by 10 steps per cycle
// instead of 16 where they suffice; a series for weak damping and no blending of full vectors (8 %); flags
// collected as bits (3 %). The number of slots hardly matters from 256 to 2048: many fill the vectors, few stay
// in the cache. With AVX2: lanes pushed one by one (a fifth; GCC copies the table of a vector's compression to
// the stack each time), single loads instead of gathers (a twentieth). In maps, where slow departures are many,
// turn() is worth a tenth.
#if defined(PETERKA_BATCH_KERNEL_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef PETERKA_BATCH_KERNEL_INL_HPP
#undef PETERKA_BATCH_KERNEL_INL_HPP
#else
#define PETERKA_BATCH_KERNEL_INL_HPP
#endif

#include <algorithm>
#include <bit>
#include <type_traits>

#include "batch/long_contact-inl.hpp"
#include "batch/meeting-inl.hpp"
#include "batch/queues-inl.hpp"
#include "batch/short_contact-inl.hpp"
#include "batch/track-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace peterka::batch::HWY_NAMESPACE {

template <bool measure, bool jacobian, bool cubic>
class Kernel {
  public:
    Kernel(const Rig& rig, const Grid& grid, const Lanes& lanes, Queues& queues)
        : rig_(rig), grid_(grid), lanes_(lanes), queues_(queues), steps_(grid.steps), until_(steps_) {}

    HWY_ATTR void run() {
        begin();
        if constexpr (!cubic) drain();
        for (int n = 0; n < grid_.steps; ++n) {
            if constexpr (cubic) {
                until_ = n + 1;
                kick_held(n == 0 ? 0.5 : 1);
            }
            step(n);
            strike_all(n);
            drain();
        }
        if constexpr (cubic) {
            finish_kicks();
        } else {
            finish();
        }
    }

  private:
    using Gathered = Track<measure, jacobian, cubic>;
    static constexpr bool keeps_legs = Gathered::keeps_legs;

    HWY_ATTR void begin();
    HWY_ATTR void step(int n);
    HWY_ATTR void strike_all(int n);
    HWY_ATTR void drain();
    HWY_ATTR void hop();
    HWY_ATTR void stay();
    HWY_ATTR void release_all();
    HWY_ATTR void turn();
    HWY_ATTR void touch(const Cells& cells, V time, const Moment& m, Mask which, Gathered& track);
    HWY_ATTR Mask touch_shortly(const Cells& cells, V time, const Moment& m, Mask which, Gathered& track);
    HWY_ATTR void release(const Cells& cells, V time, const Moment& m, Mask which, Gathered& track);
    HWY_ATTR void finish();
    HWY_ATTR void kick_held(double part);
    HWY_ATTR void kick_held(Queue& held, Queue& ready, bool pressed, double part);
    HWY_ATTR void finish_kicks();

    HWY_ATTR Cells cells_of(Index lanes) const {
        return {rig_, lanes_, steps_, lanes, std::bool_constant<cubic>()};
    }
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
    // The flow of a stretch of flight, and its end. With a cubic spring no stretch is longer than a step.
    HWY_INLINE FlowOf flown(const Cells& cells, V length) const {
        return cubic ? soon_flow(rig_, cells, length) : flight_flow(rig_, cells, length);
    }
    HWY_INLINE static Moment end_of(const Flight& flight, V length) {
        return cubic ? flight.soon(length) : flight.at(length);
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
    HWY_ATTR void hold(const Cells& cells, V delta, V velocity, Mask which, Queue& held);

    const Rig& rig_;
    const Grid& grid_;
    const Lanes& lanes_;
    Queues& queues_;
    double steps_;
    double until_;          // grid point up to which events are followed now
    Mask real_ = every();   // of the vector of lanes in hand: not padding
    std::size_t next_ = 0;  // which of the two states is that of the coming grid point
};

// All lanes at forcing phase 0, sorted by phase.
template <bool measure, bool jacobian, bool cubic>
HWY_ATTR void Kernel<measure, jacobian, cubic>::begin() {
    const V zero = all(0);
    queues_.twin.size = 0;
    next_ = 0;
    real_ = every();
    for (std::size_t i = 0; i < in_vectors(lanes_.size); i += width()) {
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
        const V rest_position = cubic ? load(lanes_.flight_rest + i) : gap;
        const V x = delta + rest_position - load(lanes_.flight_im + i);
        const V v = neg_mul_add(eta, load(lanes_.flight_re + i), velocity);
        const V inverse_rate = cubic ? all(1) / load(lanes_.flight_rate + i) : all(1 / rig_.flight_rate);
        const V quadrature = mul_add(all(rig_.damping_ratio), x, v) * inverse_rate;
        const V amplitude = sqrt(mul_add(x, x, quadrature * quadrature));
        const V square = eta * eta;
        const V stiff = cubic ? load(lanes_.flight_square + i) : all(1);
        const V fourth = mul_add(square * square, load(lanes_.swing + i), stiff * stiff * amplitude);
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
            store(zero, lanes_.peak_force + i);
            store(zero, lanes_.largest_displacement + i);
        }
        if constexpr (Gathered::bounds_legs) {
            const V u = delta + gap;
            store(amplitude, lanes_.leg_amplitude + i);
            store(sqrt(mul_add(u, u, velocity * velocity)), lanes_.leg_energy + i);
        }
        if constexpr (keeps_legs) store(zero, lanes_.leg_start + i);
        if constexpr (jacobian) {
            for (const std::size_t n : {0U, 1U, 2U, 3U}) store(all(n % 3 == 0 ? 1 : 0), lanes_.jacobian[n] + i);
        }
        const Moment start{delta, velocity, zero, all(1)};
        push(index, zero, zero, start, in_use & contact, cubic ? queues_.held_contacts : queues_.contacts);
        push(index, zero, zero, start, in_use & rest, cubic ? queues_.held_releases : queues_.releases);
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
template <bool measure, bool jacobian, bool cubic>
HWY_ATTR void Kernel<measure, jacobian, cubic>::step(int n) {
    const std::size_t now = next_;
    next_ = 1 - now;
    real_ = every();
    const double* HWY_RESTRICT delta = lanes_.delta[now];
    double* HWY_RESTRICT velocity = lanes_.velocity[now];
    double* HWY_RESTRICT next_delta = lanes_.delta[next_];
    double* HWY_RESTRICT next_velocity = lanes_.velocity[next_];
    const V sine = all(grid_.sine[static_cast<std::size_t>(n)]);
    const V cosine = all(grid_.cosine[static_cast<std::size_t>(n)]);
    const V here = all(n);
    const V cubic_part = all(n == 0 ? rig_.cubic / 2 : rig_.cubic);  // of it that acts in this kick
    const std::size_t size = in_vectors(lanes_.size);
    const Lanes lanes = lanes_;  // so that the compiler knows that no store changes them
    for (std::size_t word = 0; word < size; word += 64) {
        std::uint64_t rises = 0;  // a bit per lane: above the stop at the step's end; or perhaps in between
        std::uint64_t hops = 0;
        for (std::size_t i = word; i < std::min(word + 64, size); i += width()) {
            const V x0 = load(delta + i);
            V v0 = load(velocity + i);
            const V h = load(lanes.step + i);
            V margin = load(lanes.margin + i);
            const Mask active = load(lanes.next + i) <= here;
            const V gap = load(lanes.gap + i);
            V kick_slope = all(0);
            if constexpr (cubic) {
                const Kick kick(cubic_part * h, gap, x0);
                v0 = choose(active, v0 - kick.speed, v0);
                kick_slope = choose(active, kick.slope, all(0));
                margin = mul_add(abs(kick.speed), load(lanes.margin_per_speed + i), margin);
                store(v0, velocity + i);
                store(margin, lanes.margin + i);
            }
            const V c = load(lanes.flow_cosine + i);
            const V s = load(lanes.flow_sine + i);
            const V slope = load(lanes.flow_slope + i);
            const V push_by = mul_add(load(lanes.push_sine + i), sine,
                                      mul_add(load(lanes.push_cosine + i), cosine, load(lanes.push_rest + i)));
            const V kick_by = mul_add(load(lanes.kick_sine + i), sine,
                                      mul_add(load(lanes.kick_cosine + i), cosine, load(lanes.kick_rest + i)));
            const V x1 = mul_add(c, x0, mul_add(s, v0, push_by));
            const V fall = cubic ? load(lanes.flow_fall + i) : s;
            const V v1 = neg_mul_add(fall, x0, mul_add(slope, v0, kick_by));
            const Hull hull(x0, v0, x1, v1, h, margin);
            const Mask above = active & (x1 > all(0));
            const V inside = max(max(hull.b1, hull.b2), hull.b3);
            const Mask between = active & (inside > all(0));
            store(choose(active, x1, x0), next_delta + i);
            store(choose(active, v1, v0), next_velocity + i);
            if constexpr (cubic && measure) {
                // in flight it stays below the stop
                const V highest = min(max(inside, max(x0, x1)), all(0));
                const V bound = max(abs(highest + gap), abs(hull.lowest(margin) + gap));
                const V largest = load(lanes.largest_displacement + i);
                store(choose(active, max(largest, bound), largest), lanes.largest_displacement + i);
            }
            if constexpr (cubic && jacobian) {
                const V j00 = load(lanes.jacobian[0] + i);
                const V j01 = load(lanes.jacobian[1] + i);
                const V j10 = load(lanes.jacobian[2] + i);
                const V j11 = load(lanes.jacobian[3] + i);
                const V k10 = neg_mul_add(kick_slope, j00, j10);
                const V k11 = neg_mul_add(kick_slope, j01, j11);
                const Mask flies = active & ~(above | between);  // events carry the others
                const FlowOf f{c, s, -fall, slope};
                store(choose(flies, f.position(j00, k10), j00), lanes.jacobian[0] + i);
                store(choose(flies, f.position(j01, k11), j01), lanes.jacobian[1] + i);
                store(choose(flies, f.velocity(j00, k10), k10), lanes.jacobian[2] + i);
                store(choose(flies, f.velocity(j01, k11), k11), lanes.jacobian[3] + i);
            }
            rises |= bits(above) << (i - word);
            hops |= bits(between & ~above) << (i - word);
        }
        for (; rises != 0; rises &= rises - 1) {
            const std::size_t lane = word + static_cast<std::size_t>(std::countr_zero(rises));
            queues_.crossings.lane[queues_.crossings.size++] = static_cast<std::int64_t>(lane);
            if constexpr (cubic && jacobian) lanes.leg_start[lane] = n * lanes.step[lane];
        }
        for (; hops != 0; hops &= hops - 1) {
            const std::size_t lane = word + static_cast<std::size_t>(std::countr_zero(hops));
            const auto point = static_cast<std::size_t>(n);
            queues_.hops.add(static_cast<std::int64_t>(lane),
                             {n + 1.0, n * lanes.step[lane], delta[lane], velocity[lane], grid_.sine[point],
                              grid_.cosine[point]});
            if constexpr (cubic && jacobian) lanes.leg_start[lane] = n * lanes.step[lane];
        }
    }
}

// Closes the last leg of each lane.
template <bool measure, bool jacobian, bool cubic>
HWY_ATTR void Kernel<measure, jacobian, cubic>::finish() {
    const V zero = all(0);
    for (std::size_t i = 0; i < in_vectors(lanes_.size); i += width()) {
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
                const FlowOf f = flow(sine_cosine(all(rig_.flight_rate) * duration),
                                      exp_of(all(-rig_.damping_ratio) * duration), all(rig_.damping_ratio),
                                      all(1), all(1 / rig_.flight_rate));
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

template <bool cubic>
HWY_ATTR void run_kernel(const Rig& rig, const Grid& grid, const Lanes& lanes, Queues& queues, Wanted wanted) {
    if (wanted.measure && wanted.jacobian) return Kernel<true, true, cubic>(rig, grid, lanes, queues).run();
    if (wanted.measure) return Kernel<true, false, cubic>(rig, grid, lanes, queues).run();
    if (wanted.jacobian) return Kernel<false, true, cubic>(rig, grid, lanes, queues).run();
    return Kernel<false, false, cubic>(rig, grid, lanes, queues).run();
}

}  // namespace peterka::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#include "batch/departures-inl.hpp"
#include "batch/events-inl.hpp"
#include "batch/kicks-inl.hpp"
#endif
