// What a trajectory of each lane has gathered in this cycle: in registers while its lane is treated, in the
// table meanwhile.
#if defined(PETERKA_BATCH_TRACK_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef PETERKA_BATCH_TRACK_INL_HPP
#undef PETERKA_BATCH_TRACK_INL_HPP
#else
#define PETERKA_BATCH_TRACK_INL_HPP
#endif

#include "batch/functions-inl.hpp"
#include "trajectory/cycle.hpp"

HWY_BEFORE_NAMESPACE();
namespace peterka::batch::HWY_NAMESPACE {

HWY_INLINE Pattern patterns(trajectory::Phase phase) {
    const auto one = hn::Set(PatternTag(), trajectory::pattern_of(phase));
    return {one, one};
}
// (p ^ phase) 0x100000001b3 as shifts, which every instruction set has: see trajectory/cycle.hpp.
HWY_INLINE hn::Vec<PatternTag> append(hn::Vec<PatternTag> p, hn::Vec<PatternTag> phase) {
    const auto x = hn::Xor(p, phase);
    const auto low = hn::Add(hn::Add(hn::ShiftLeft<8>(x), hn::ShiftLeft<7>(x)),
                             hn::Add(hn::ShiftLeft<5>(x), hn::ShiftLeft<4>(x)));
    return hn::Add(hn::Add(hn::ShiftLeft<40>(x), low), hn::Add(hn::ShiftLeft<1>(x), x));
}
HWY_INLINE Pattern append(Pattern p, trajectory::Phase phase) {
    const Pattern next = patterns(phase);
    return {append(p.a, next.a), append(p.b, next.b)};
}
static_assert(trajectory::append(1, 0) == (1ULL << 40) + 256 + 128 + 32 + 16 + 2 + 1);

template <bool measure, bool jacobian, bool cubic>
struct Track {
    // With a cubic spring the displacement is bounded from step to step.
    static constexpr bool bounds_legs = measure && !cubic;
    static constexpr bool keeps_legs = bounds_legs || jacobian;

    HWY_INLINE Track(const Lanes& lanes, Index which)
        : pattern(gather(lanes.pattern, which)), impacts(gather(lanes.impacts, which)) {
        if constexpr (measure) {
            peak_force = gather(lanes.peak_force, which);
            largest = gather(lanes.largest_displacement, which);
        }
        if constexpr (bounds_legs) {
            leg_amplitude = gather(lanes.leg_amplitude, which);
            leg_energy = gather(lanes.leg_energy, which);
            swing = gather(lanes.swing, which);
        }
        if constexpr (keeps_legs) leg_start = gather(lanes.leg_start, which);
        if constexpr (jacobian) {
            j00 = gather(lanes.jacobian[0], which);
            j01 = gather(lanes.jacobian[1], which);
            j10 = gather(lanes.jacobian[2], which);
            j11 = gather(lanes.jacobian[3], which);
        }
    }
    HWY_INLINE void keep(const Lanes& lanes, Index which) const {
        scatter(pattern, lanes.pattern, which);
        scatter(impacts, lanes.impacts, which);
        if constexpr (measure) {
            scatter(peak_force, lanes.peak_force, which);
            scatter(largest, lanes.largest_displacement, which);
        }
        if constexpr (bounds_legs) {
            scatter(leg_amplitude, lanes.leg_amplitude, which);
            scatter(leg_energy, lanes.leg_energy, which);
        }
        if constexpr (keeps_legs) scatter(leg_start, lanes.leg_start, which);
        if constexpr (jacobian) {
            scatter(j00, lanes.jacobian[0], which);
            scatter(j01, lanes.jacobian[1], which);
            scatter(j10, lanes.jacobian[2], which);
            scatter(j11, lanes.jacobian[3], which);
        }
    }

    HWY_INLINE void carry(const FlowOf& f, Mask where) {
        const V a = f.position(j00, j10);
        const V b = f.position(j01, j11);
        const V c = f.velocity(j00, j10);
        const V d = f.velocity(j01, j11);
        j00 = choose(where, a, j00);
        j01 = choose(where, b, j01);
        j10 = choose(where, c, j10);
        j11 = choose(where, d, j11);
    }
    // The force jumps by chi v.
    HWY_INLINE void jump(double damping, Mask where) {
        j10 = choose(where, neg_mul_add(all(damping), j00, j10), j10);
        j11 = choose(where, neg_mul_add(all(damping), j01, j11), j11);
    }
    HWY_INLINE void raise_displacement(V bound, Mask where) {
        largest = choose(where, max(largest, bound), largest);
    }

    Pattern pattern;
    V impacts;
    V peak_force, largest, leg_amplitude, leg_energy, swing, leg_start;
    V j00, j01, j10, j11;
};

}  // namespace peterka::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
