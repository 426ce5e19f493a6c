// One forcing cycle of many cells at once.
//
// All lanes march together over a grid of forcing phases. A step of free flight is one affine map of (delta,
// delta') per lane; its flag test asks whether the lane can have risen above the stop meanwhile (Hull,
// flight-inl.hpp). The few flagged lanes wait in a queue per kind of event until they suffice to fill a vector
// or the march has made enough rounds. Then they are gathered from the whole batch, and carried through entry,
// contact and release to the next grid point. When the march reaches it, in this round or the next one, they
// rejoin it:
//
//   step        every lane at its grid point    -> crossings, hops
//   strike      crossings: above at step's end  -> touch, or hops
//   touch       an impact begins                -> short contact and release, or contacts
//   stay        contacts of any length          -> release, or the cycle's end
//   release     the stop lets go                -> grid point after it, hops, or turns
//   turn        it leaves slowly                -> contacts again, grid point, or hops
//   hop         flights that may rise above     -> touch, or nothing happened
//
// With a cubic spring (`cubic`; see trajectory/split_cycle_map.hpp) each grid point brings a kick, and events
// are followed only to the next grid point: a lane that is then at the stop is held there, and continues after
// its kick (kick_held), as a contact of any length. Each lane has its own linear equations.
//
// With a rigid stop (`rigid`; rigid-inl.hpp) a touch is an impact, and the only contact that follows is rest:
//
//   touch       an impact                       -> turns, rest, a grid point, or hops
//   bounce      turns: soon back, impact after  -> rest, a grid point, or hops
//               impact
//   rest        at rest until the stop presses  -> grid point after it, hops, or the cycle's end
//               no longer
//
// Each decision is proved (no event is taken for the first, or for absent, on the strength of samples); where a
// proof fails the lane is left to the scalar twin (trajectory/exact_cycle_map.hpp or split_cycle_map.hpp),
// which repeats its cycle from the start. A lane's numbers never depend on other lanes: loops run until all
// lanes of a vector are done, and lanes that are done keep their values.
//
// Optimizations that pay, measured on the eight cells of tests/benchmark/batch_cycles.cpp with AVX-512: events
// of the whole batch together in full vectors; short contacts by Newton's method from guesses (touch 37 -> 11
// ns per cycle); two vectors at once, which hide each other's latency (a sixth of the time); 10 steps per cycle
// instead of 16 where they suffice (a tenth); a series for weak damping and no blending of full vectors (8 %);
// flags collected as bits (3 %). Events that wait for others, even beyond a round of the march: with 128 slots
// each vector of a map's crossings holds 12 lanes instead of 9, one of its long contacts 5 instead of 2, and a
// cycle takes a fifth less time. The number of slots hardly matters from 256 to 2048: many fill the vectors,
// few stay in the cache. With AVX2: lanes pushed one by one (a fifth; GCC copies the table of a vector's
// compression to the stack each time), single loads instead of gathers (a twentieth). In maps, where slow
// departures are frequent, turn() saves a tenth.
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

// The effect of a step on a vector of lanes: a bit for each lane above the stop at its end, and for each that
// may have been above it in between.
struct Flags {
    std::uint64_t rises = 0;
    std::uint64_t hops = 0;
};

// Whether a rigid stop presses a hammer at rest on it, at phases from 0 to a full turn.
HWY_INLINE Mask presses(V from, V to, V theta) {
    const Mask wraps = to < from;
    const Mask after = theta >= from;
    const Mask before = theta <= to;
    return (wraps & (after | before)) | (~wraps & after & before);
}

// The forcing's phase at a step's start.
using Forced = SineCosine;

// own: each lane has its own rig.
template <Law law, bool own>
class Kernel {
  public:
    Kernel(const Grid& grid, const Lanes& lanes, Queues& queues) requires own : rig_(),
                                                                                grid_(grid),
                                                                                lanes_(lanes),
                                                                                queues_(queues),
                                                                                steps_(grid.steps) {}
    Kernel(const Rig& rig, const Grid& grid, const Lanes& lanes, Queues& queues) requires(!own)
        : rig_(rig), grid_(grid), lanes_(lanes), queues_(queues), steps_(grid.steps) {}

    HWY_ATTR void run(bool whole) {
        begin();
        const std::size_t fill = std::clamp(lanes_.size / lanes_per_fill, std::size_t{1}, most_fill);
        drain(fill);
        for (int n = earliest();; n = earliest()) {
            for (; n < grid_.steps; ++n) {
                step(n);
                drain(fill);
            }
            if (!whole) break;
            drain(1);
            if (earliest() == grid_.steps) break;
        }
        for (Queue* queue : queues_.events()) queue->passes = queue->size > 0 ? queue->passes + 1 : 0;
        if constexpr (cubic) {
            finish_kicks();
        } else {
            finish();
        }
    }

  private:
    static constexpr bool cubic = law == Law::kicks;
    static constexpr bool rigid = law == Law::rigid;
    using Gathered = Track<law>;
    // An event needs one in lanes_per_fill of the batch's lanes, at most most_fill, to be worth its vectors;
    // where cycles need not be whole, fewer wait for up to longest_wait rounds of the march.
    static constexpr std::size_t lanes_per_fill = 8;
    static constexpr std::size_t most_fill = 12;
    static constexpr int longest_wait = 4;
    using Whose = std::conditional_t<own, OwnRigs, const Rig&>;
    using Cells = CellsOf<Whose>;
    using Contact = ContactOf<cubic, Cells>;

    HWY_ATTR void begin();
    HWY_INLINE V begin_flight(std::size_t i, V delta, V velocity, Mask which) const;
    [[nodiscard]] HWY_ATTR int earliest() const;
    HWY_ATTR void step(int n);
    HWY_INLINE V kick(const Lanes& lanes, std::size_t i, Mask active, V cubic_part) const;
    HWY_INLINE Flags fly(const Lanes& lanes, std::size_t i, Mask active, const Forced& forced,
                         V kick_slope) const;
    HWY_ATTR void enqueue(std::size_t first_lane, int n, Flags flags);
    HWY_ATTR void strike();
    HWY_ATTR void drain(std::size_t fill);
    HWY_ATTR bool drain_stop(auto is_ripe);
    HWY_ATTR void hop();
    HWY_ATTR void stay();
    HWY_ATTR void release_all();
    HWY_ATTR void turn();
    HWY_ATTR void touch(const Cells& cells, V time, const Moments& m, V until, Mask which, Gathered& track);
    HWY_ATTR void press(const Cells& cells, V time, const Moments& m, V until, Mask which, Gathered& track);
    HWY_ATTR Mask touch_shortly(const Cells& cells, V time, const Moments& m, V until, Mask which,
                                Gathered& track);
    struct Struck;
    HWY_ATTR Struck strike_rigid(const Cells& cells, V time, const Moments& m, Mask which, Gathered& track);
    HWY_ATTR void rebound(const Cells& cells, V time, const Moments& m, Mask which, Gathered& track);
    HWY_ATTR void bounce();
    HWY_ATTR void depart(const Cells& cells, V time, const Moments& m, Mask which, Gathered& track);
    HWY_ATTR void rest();
    HWY_ATTR void fall(const Cells& cells, V time, const Moments& m, Mask which, Gathered& track);
    HWY_ATTR void release(const Cells& cells, V time, const Moments& m, V until, Mask which, Gathered& track);
    HWY_ATTR void finish();
    HWY_ATTR void kick_held(Queue& held, Queue& ready, bool pressed);
    HWY_ATTR void finish_kicks();

    HWY_ATTR Cells cells_of(Index lanes) const {
        if constexpr (own) {
            const OwnRigs rigs([&](Field field) HWY_ATTR { return gather(lanes_[field], lanes); });
            return {rigs, lanes_, steps_, lanes, std::bool_constant<cubic>()};
        } else {
            return {rig_, lanes_, steps_, lanes, std::bool_constant<cubic>()};
        }
    }
    // The rig of the vector of lanes that begins at i.
    HWY_INLINE Whose rig_at(std::size_t i) const {
        if constexpr (own) {
            return OwnRigs([&](Field field) HWY_ATTR { return load(lanes_[field] + i); });
        } else {
            return rig_;
        }
    }
    // Takes lanes off a queue; from then on `real_` marks those that are not padding.
    HWY_ATTR Waiting take(Queue& queue) {
        const Waiting waiting = batch::HWY_NAMESPACE::take(queue);
        real_ = waiting.real;
        queue.passes = 0;
        return waiting;
    }
    // The grid point up to which events that begin in a flight are followed.
    HWY_INLINE V until(const Waiting& flight) const { return cubic ? flight.end : all(steps_); }
    // The flow of a stretch of flight, and its end. With a cubic spring no stretch is longer than a step.
    HWY_INLINE Matrix2 flown(const Cells& cells, V length) const {
        return cubic ? soon_flow(cells, length) : flight_flow(cells, length);
    }
    HWY_INLINE static Moments end_of(const Flight<Cells>& flight, V length) {
        return cubic ? flight.soon(length) : flight.at(length);
    }
    // Begins a flight at a time, or ends it after a duration; flow: that of this duration.
    HWY_INLINE static void begin_leg(const Cells& cells, V time, const Moments& m, Mask which,
                                     Gathered& track) {
        if constexpr (!cubic) {
            const V u = m.delta + cells.gap;
            track.leg_amplitude = choose(which, Flight(cells, m).amplitude(), track.leg_amplitude);
            track.leg_energy = choose(which, sqrt(mul_add(u, u, m.velocity * m.velocity)), track.leg_energy);
        }
        track.leg_start = choose(which, time, track.leg_start);
    }
    HWY_INLINE static void end_leg(const Cells& cells, V duration, const Matrix2& flow, Mask which,
                                   Gathered& track) {
        if constexpr (!cubic) {
            track.raise_displacement(
                min(track.swing + track.leg_amplitude, mul_add(cells.drive, duration, track.leg_energy)),
                which);
        }
        track.carry(flow, which);
    }
    // An elastic stop releases at delta = 0, up to rounding.
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
    HWY_ATTR void hold(const Cells& cells, V delta, V velocity, V grid_point, Mask which, Queue& held);

    struct None {};
    std::conditional_t<own, None, const Rig&> rig_;
    const Grid& grid_;
    const Lanes& lanes_;
    Queues& queues_;
    double steps_;
    Mask real_ = every();  // of the current vector of lanes: not padding
};

}  // namespace peterka::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#include "batch/begin-inl.hpp"
#include "batch/departures-inl.hpp"
#include "batch/events-inl.hpp"
#include "batch/kicks-inl.hpp"
#include "batch/march-inl.hpp"
#include "batch/rigid-inl.hpp"
#endif
