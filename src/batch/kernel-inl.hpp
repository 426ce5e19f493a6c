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
#include <type_traits>

#include "batch/long_contact-inl.hpp"
#include "batch/meeting-inl.hpp"
#include "batch/queues-inl.hpp"
#include "batch/short_contact-inl.hpp"
#include "batch/track-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace peterka::batch::HWY_NAMESPACE {

// What a step did to a vector of lanes: a bit for each that is above the stop at its end, and for each that may
// have been in between.
struct Flags {
    std::uint64_t rises = 0;
    std::uint64_t hops = 0;
};

// The forcing's phase at a step's start.
using Forced = SineCosine;

// own: each lane has a rig of its own.
template <bool measure, bool jacobian, bool cubic, bool own>
class Kernel {
  public:
    Kernel(const Grid& grid, const Lanes& lanes, Queues& queues) requires own : rig_(),
                                                                                grid_(grid),
                                                                                lanes_(lanes),
                                                                                queues_(queues),
                                                                                steps_(grid.steps),
                                                                                until_(steps_) {}
    Kernel(const Rig& rig, const Grid& grid, const Lanes& lanes, Queues& queues) requires(!own)
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
    using Whose = std::conditional_t<own, OwnRigs, const Rig&>;
    using Cells = CellsOf<Whose>;
    using Contact = ContactOf<cubic, Cells>;

    HWY_ATTR void begin();
    HWY_INLINE V begin_flight(std::size_t i, V delta, V velocity) const;
    HWY_ATTR void step(int n);
    HWY_INLINE V kick(const Lanes& lanes, std::size_t i, Mask active, V cubic_part) const;
    HWY_INLINE Flags fly(const Lanes& lanes, std::size_t i, Mask active, const Forced& forced,
                         V kick_slope) const;
    HWY_ATTR void enqueue(std::size_t first_lane, int n, Flags flags);
    HWY_ATTR void strike_all(int n);
    HWY_ATTR void drain();
    HWY_ATTR void hop();
    HWY_ATTR void stay();
    HWY_ATTR void release_all();
    HWY_ATTR void turn();
    HWY_ATTR void touch(const Cells& cells, V time, const Moments& m, Mask which, Gathered& track);
    HWY_ATTR Mask touch_shortly(const Cells& cells, V time, const Moments& m, Mask which, Gathered& track);
    HWY_ATTR void release(const Cells& cells, V time, const Moments& m, Mask which, Gathered& track);
    HWY_ATTR void finish();
    HWY_ATTR void kick_held(double part);
    HWY_ATTR void kick_held(Queue& held, Queue& ready, bool pressed, double part);
    HWY_ATTR void finish_kicks();

    HWY_ATTR Cells cells_of(Index lanes) const {
        if constexpr (own) {
            const OwnRigs rigs([&](Field field) HWY_ATTR { return gather(lanes_[field], lanes); });
            return {rigs, lanes_, steps_, lanes, std::bool_constant<cubic>()};
        } else {
            return {rig_, lanes_, steps_, lanes, std::bool_constant<cubic>()};
        }
    }
    // Of the vector of lanes that begins there.
    HWY_INLINE Whose rig_at(std::size_t i) const {
        if constexpr (own) {
            return OwnRigs([&](Field field) HWY_ATTR { return load(lanes_[field] + i); });
        } else {
            return rig_;
        }
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
    HWY_INLINE Matrix2 flown(const Cells& cells, V length) const {
        return cubic ? soon_flow(cells, length) : flight_flow(cells, length);
    }
    HWY_INLINE static Moments end_of(const Flight<Cells>& flight, V length) {
        return cubic ? flight.soon(length) : flight.at(length);
    }
    // An elastic stop lets go at delta = 0, give or take a rounding error.
    HWY_ATTR static Moments let_go(const Moments& m) {
        return {max(m.delta, all(0)), m.velocity, m.sine, m.cosine};
    }
    HWY_ATTR void leave_to_twin(const Cells& cells, Mask which) {
        if (!any(which)) return;
        push(cells.index, which & real_, queues_.twin);
        put(all(never), lanes_[Field::next], cells.index, which);
    }
    HWY_ATTR static void put(V x, double* to, Index lanes, Mask which) {
        scatter(everywhere(which) ? x : choose(which, x, gather(to, lanes)), to, lanes);
    }
    HWY_ATTR void arrive(const Cells& cells, V delta, V velocity, V grid_point, V fourth_derivative,
                         Mask which);
    HWY_ATTR void hold(const Cells& cells, V delta, V velocity, Mask which, Queue& held);

    struct None {};
    std::conditional_t<own, None, const Rig&> rig_;
    const Grid& grid_;
    const Lanes& lanes_;
    Queues& queues_;
    double steps_;
    double until_;          // grid point up to which events are followed now
    Mask real_ = every();   // of the vector of lanes in hand: not padding
    std::size_t next_ = 0;  // which of the two states is that of the coming grid point
};

template <bool cubic>
HWY_ATTR void run_kernel(const Rig& rig, const Grid& grid, const Lanes& lanes, Queues& queues, Wanted wanted) {
    constexpr bool own = false;
    if (wanted.measure && wanted.jacobian)
        return Kernel<true, true, cubic, own>(rig, grid, lanes, queues).run();
    if (wanted.measure) return Kernel<true, false, cubic, own>(rig, grid, lanes, queues).run();
    if (wanted.jacobian) return Kernel<false, true, cubic, own>(rig, grid, lanes, queues).run();
    return Kernel<false, false, cubic, own>(rig, grid, lanes, queues).run();
}

// Of lanes with rigs of their own, the Jacobian always: who wants only states has one rig.
template <bool cubic>
HWY_ATTR void run_own_kernel(const Grid& grid, const Lanes& lanes, Queues& queues, Wanted wanted) {
    constexpr bool own = true;
    if (wanted.measure) return Kernel<true, true, cubic, own>(grid, lanes, queues).run();
    return Kernel<false, true, cubic, own>(grid, lanes, queues).run();
}

}  // namespace peterka::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#include "batch/begin-inl.hpp"
#include "batch/departures-inl.hpp"
#include "batch/events-inl.hpp"
#include "batch/kicks-inl.hpp"
#include "batch/march-inl.hpp"
#endif
