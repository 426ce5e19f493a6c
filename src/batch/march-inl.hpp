// The march of lanes in flight from grid point to grid point; included by kernel-inl.hpp.
#if defined(PETERKA_BATCH_MARCH_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef PETERKA_BATCH_MARCH_INL_HPP
#undef PETERKA_BATCH_MARCH_INL_HPP
#else
#define PETERKA_BATCH_MARCH_INL_HPP
#endif

#include <algorithm>
#include <bit>

#include "batch/kernel-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace peterka::batch::HWY_NAMESPACE {

// The first grid point with a lane to march; the end of the cycle if there is none.
template <Law law, bool own>
HWY_ATTR int Kernel<law, own>::earliest() const {
    const double* next = lanes_[Field::next];
    double point = steps_;
    for (std::size_t i = 0; i < lanes_.size; ++i) point = std::min(point, next[i]);
    return static_cast<int>(point);
}

// Advances all lanes at grid point n to the next one.
template <Law law, bool own>
HWY_ATTR void Kernel<law, own>::step(int n) {
    const auto point = static_cast<std::size_t>(n);
    const Forced forced{all(grid_.sine[point]), all(grid_.cosine[point])};
    const V here = all(n);
    const double part = n == 0 ? 0.5 : 1;  // of the cubic that acts in this kick
    V cubic_part = all(0);
    if constexpr (cubic && !own) cubic_part = all(part * rig_.cubic);
    const Lanes lanes = lanes_;  // tells the compiler that no store changes them
    const std::size_t size = in_vectors(lanes.size);
    for (std::size_t word = 0; word < size; word += 64) {
        Flags flags;
        for (std::size_t bit = 0; bit < std::min<std::size_t>(64, size - word); bit += width()) {
            const std::size_t i = word + bit;
            const Mask active = load(lanes[Field::next] + i) == here;
            if (!any(active)) continue;
            V kick_slope = all(0);
            if constexpr (cubic && own) cubic_part = all(part * rig_at(i).cubic);
            if constexpr (cubic) kick_slope = kick(lanes, i, active, cubic_part);
            const Flags these = fly(lanes, i, active, forced, kick_slope);
            flags.rises |= these.rises << bit;
            flags.hops |= these.hops << bit;
        }
        enqueue(word, n, flags);
    }
}

// Kicks a vector of lanes, and returns the kick's derivative by delta.
template <Law law, bool own>
HWY_INLINE V Kernel<law, own>::kick(const Lanes& lanes, std::size_t i, Mask active, V cubic_part) const {
    const Kick kick(cubic_part * load(lanes[Field::step] + i), load(lanes[Field::gap] + i),
                    load(lanes[Field::delta] + i));
    double* velocity = lanes[Field::velocity] + i;
    const V before = load(velocity);
    store(choose(active, before - kick.speed, before), velocity);
    double* margin = lanes[Field::margin] + i;
    const V usual = load(margin);
    store(choose(active, mul_add(abs(kick.speed), load(lanes[Field::margin_per_speed] + i), usual), usual),
          margin);
    return choose(active, kick.slope, all(0));
}

// One step of flight of a vector of lanes, and its flag test.
template <Law law, bool own>
HWY_INLINE Flags Kernel<law, own>::fly(const Lanes& lanes, std::size_t i, Mask active, const Forced& forced,
                                       V kick_slope) const {
    const V x0 = load(lanes[Field::delta] + i);
    const V v0 = load(lanes[Field::velocity] + i);
    const V margin = load(lanes[Field::margin] + i);
    const auto forced_part = [&](Field by_sine, Field by_cosine, Field constant) HWY_ATTR {
        const V slow = mul_add(load(lanes[by_cosine] + i), forced.cosine, load(lanes[constant] + i));
        return mul_add(load(lanes[by_sine] + i), forced.sine, slow);
    };
    const V forced_delta =
        forced_part(Field::forced_delta_sine, Field::forced_delta_cosine, Field::forced_delta_constant);
    const V forced_velocity = forced_part(Field::forced_velocity_sine, Field::forced_velocity_cosine,
                                          Field::forced_velocity_constant);
    const V e01 = load(lanes[Field::e01] + i);
    const V e10 = cubic ? load(lanes[Field::e10] + i) : e01;  // without a cubic spring, -e01
    const Matrix2 flow{load(lanes[Field::e00] + i), e01, e10, load(lanes[Field::e11] + i)};
    const V x1 = mul_add(flow.e00, x0, mul_add(flow.e01, v0, forced_delta));
    const V by_velocity = mul_add(flow.e11, v0, forced_velocity);
    const V v1 = cubic ? mul_add(e10, x0, by_velocity) : neg_mul_add(e01, x0, by_velocity);
    const Hull hull(x0, v0, x1, v1, load(lanes[Field::step] + i), margin);
    const V inside = max(max(hull.b1, hull.b2), hull.b3);
    const Mask above = active & (x1 > all(0));
    const Mask between = active & (inside > all(0));
    store(x0, lanes[Field::delta_before] + i);
    store(v0, lanes[Field::velocity_before] + i);
    store(choose(active, x1, x0), lanes[Field::delta] + i);
    store(choose(active, v1, v0), lanes[Field::velocity] + i);
    const V next = load(lanes[Field::next] + i);
    store(choose(active, choose(above | between, all(never), next + all(1)), next), lanes[Field::next] + i);
    if constexpr (cubic) {
        const V gap = load(lanes[Field::gap] + i);
        const V highest = min(max(inside, max(x0, x1)), all(0));  // in flight it stays below the stop
        const V bound = max(abs(highest + gap), abs(hull.lowest(margin) + gap));
        const V largest = load(lanes[Field::largest_displacement] + i);
        store(choose(active, max(largest, bound), largest), lanes[Field::largest_displacement] + i);
        const Matrix2 j = kicked(load_jacobian(lanes, i), kick_slope);
        const Mask flies = active & ~(above | between);  // the others are carried by their events
        store_jacobian(choose(flies, flow * j, j), lanes, i);
    }
    return {bits(above), bits(between & ~above)};
}

// Queues those of up to 64 lanes that events stop in the step after grid point n.
template <Law law, bool own>
HWY_ATTR void Kernel<law, own>::enqueue(std::size_t first_lane, int n, Flags flags) {
    const auto point = static_cast<std::size_t>(n);
    const auto put_in = [&](Queue& queue, std::uint64_t left) {
        for (; left != 0; left &= left - 1) {
            const std::size_t lane = first_lane + static_cast<std::size_t>(std::countr_zero(left));
            const double time = n * lanes_[Field::step][lane];
            queue.add(static_cast<std::int64_t>(lane),
                      {n + 1.0, time, lanes_[Field::delta_before][lane], lanes_[Field::velocity_before][lane],
                       grid_.sine[point], grid_.cosine[point]});
            if constexpr (cubic) lanes_[Field::leg_start][lane] = time;
        }
    };
    put_in(queues_.crossings, flags.rises);
    put_in(queues_.hops, flags.hops);
}

}  // namespace peterka::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
