// What the trajectory of each lane has gathered in this cycle: in registers while the lane is treated,
// otherwise in the arrays.
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

HWY_INLINE Pattern patterns(trajectory::EventPattern event) {
    const auto one = hn::Set(PatternTag(), event);
    return {one, one};
}
HWY_INLINE Pattern patterns(trajectory::Phase phase) {
    return patterns(trajectory::pattern_of(phase));
}
// (p ^ phase) 0x100000001b3 as shifts, which every instruction set has: see trajectory/cycle.hpp.
HWY_INLINE hn::Vec<PatternTag> append(hn::Vec<PatternTag> p, hn::Vec<PatternTag> phase) {
    const auto x = hn::Xor(p, phase);
    const auto low = hn::Add(hn::Add(hn::ShiftLeft<8>(x), hn::ShiftLeft<7>(x)),
                             hn::Add(hn::ShiftLeft<5>(x), hn::ShiftLeft<4>(x)));
    return hn::Add(hn::Add(hn::ShiftLeft<40>(x), low), hn::Add(hn::ShiftLeft<1>(x), x));
}
HWY_INLINE Pattern append(Pattern p, auto event) {
    const Pattern next = patterns(event);
    return {append(p.a, next.a), append(p.b, next.b)};
}
static_assert(trajectory::append(1, 0) == (1ULL << 40) + 256 + 128 + 32 + 16 + 2 + 1);

template <Law law>
struct Track {
    // With a cubic spring the displacement is bounded from step to step.
    static constexpr bool bounds_legs = law != Law::kicks;
    static constexpr bool gathers_impacts = law == Law::rigid;

    HWY_INLINE Track(const Lanes& lanes, Index which)
        : pattern(gather(lanes.pattern, which)), impacts(gather(lanes[Field::impacts], which)) {
        peak_force = gather(lanes[Field::peak_force], which);
        largest = gather(lanes[Field::largest_displacement], which);
        if constexpr (gathers_impacts) {
            impact_speed = gather(lanes[Field::impact_speed], which);
            impulse = gather(lanes[Field::impulse], which);
            contact_work = gather(lanes[Field::contact_work], which);
        }
        if constexpr (bounds_legs) {
            leg_amplitude = gather(lanes[Field::leg_amplitude], which);
            leg_energy = gather(lanes[Field::leg_energy], which);
            swing = gather(lanes[Field::swing], which);
        }
        leg_start = gather(lanes[Field::leg_start], which);
        jacobian_now = gather_jacobian(lanes, which);
    }
    HWY_INLINE void keep(const Lanes& lanes, Index which) const {
        scatter(pattern, lanes.pattern, which);
        scatter(impacts, lanes[Field::impacts], which);
        scatter(peak_force, lanes[Field::peak_force], which);
        scatter(largest, lanes[Field::largest_displacement], which);
        if constexpr (gathers_impacts) {
            scatter(impact_speed, lanes[Field::impact_speed], which);
            scatter(impulse, lanes[Field::impulse], which);
            scatter(contact_work, lanes[Field::contact_work], which);
        }
        if constexpr (bounds_legs) {
            scatter(leg_amplitude, lanes[Field::leg_amplitude], which);
            scatter(leg_energy, lanes[Field::leg_energy], which);
        }
        scatter(leg_start, lanes[Field::leg_start], which);
        scatter_jacobian(jacobian_now, lanes, which);
    }

    HWY_INLINE void carry(const Matrix2& f, Mask where) {
        jacobian_now = choose(where, f * jacobian_now, jacobian_now);
    }
    // The saltation at a touch: the force jumps by chi v.
    HWY_INLINE void jump(V damping, Mask where) {
        const Matrix2 after = kicked(jacobian_now, damping);
        jacobian_now.e10 = choose(where, after.e10, jacobian_now.e10);
        jacobian_now.e11 = choose(where, after.e11, jacobian_now.e11);
    }
    // The saltation at a rigid impact: the velocity is reversed, and the slope times the position is added to
    // it.
    HWY_INLINE void reflect(V restitution, V slope, Mask where) {
        const Matrix2& j = jacobian_now;
        const Matrix2 after{-(restitution * j.e00), -(restitution * j.e01),
                            mul_sub(slope, j.e00, restitution * j.e10),
                            mul_sub(slope, j.e01, restitution * j.e11)};
        jacobian_now = choose(where, after, j);
    }
    // From here on the motion does not depend on the start.
    HWY_INLINE void forget(Mask where) {
        const V zero = all(0);
        jacobian_now = choose(where, Matrix2{zero, zero, zero, zero}, jacobian_now);
    }
    HWY_INLINE void raise_displacement(V bound, Mask where) {
        largest = choose(where, max(largest, bound), largest);
    }

    Pattern pattern;
    V impacts;
    V impact_speed, impulse, contact_work;
    V peak_force, largest, leg_amplitude, leg_energy, swing, leg_start;
    Matrix2 jacobian_now;
};

}  // namespace peterka::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
