// Lanes that wait for the same treatment, appended from any vector and taken off in full vectors.
#if defined(PETERKA_BATCH_QUEUES_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef PETERKA_BATCH_QUEUES_INL_HPP
#undef PETERKA_BATCH_QUEUES_INL_HPP
#else
#define PETERKA_BATCH_QUEUES_INL_HPP
#endif

#include <algorithm>
#include <bit>
#include <cstdint>

#include "batch/flight-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace peterka::batch::HWY_NAMESPACE {

// Few lanes of a vector are pushed at a time, so they are pushed one by one.
HWY_INLINE void push(Index lanes, Mask which, LaneList& list) {
    if (!any(which)) return;
    const Numbers lane(lanes);
    for (std::uint64_t left = bits(which); left != 0; left &= left - 1) {
        list.lane[list.size++] = lane[std::countr_zero(left)];
    }
}

HWY_INLINE void push(Index lanes, V end, V time, const Moments& m, Mask which, Queue& queue) {
    if (!any(which)) return;
    const Numbers lane(lanes);
    const Numbers ends(end);
    const Numbers times(time);
    const Numbers delta(m.delta);
    const Numbers velocity(m.velocity);
    const Numbers sine(m.sine);
    const Numbers cosine(m.cosine);
    for (std::uint64_t left = bits(which); left != 0; left &= left - 1) {
        const int n = std::countr_zero(left);
        queue.add(lane[n], {ends[n], times[n], delta[n], velocity[n], sine[n], cosine[n]});
    }
}

// A vector of lanes, padded with copies of the first: the copies compute and store the same as the first, but
// must queue nothing.
struct Waiting {
    Index lanes;
    Mask real;  // not padding
    V end, time;
    Moments moment;
};
HWY_INLINE V take_field(std::vector<double>& field, std::size_t from, std::size_t count) {
    double* number = field.data() + from;
    std::fill(number + count, number + width(), number[0]);
    return load(number);
}
HWY_INLINE Waiting take(Queue& queue) {
    const std::size_t count = std::min(width(), queue.size);
    queue.size -= count;
    const std::size_t from = queue.size;
    std::int64_t* lane = queue.lane.data() + from;
    std::fill(lane + count, lane + width(), lane[0]);
    return {load(lane),
            first(count),
            take_field(queue.end, from, count),
            take_field(queue.time, from, count),
            {take_field(queue.delta, from, count), take_field(queue.velocity, from, count),
             take_field(queue.sine, from, count), take_field(queue.cosine, from, count)}};
}

}  // namespace peterka::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
