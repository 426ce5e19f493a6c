// Lanes that wait for the same treatment, put on a list from any vector and taken off in full ones.
#if defined(PETERKA_BATCH_QUEUES_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef PETERKA_BATCH_QUEUES_INL_HPP
#undef PETERKA_BATCH_QUEUES_INL_HPP
#else
#define PETERKA_BATCH_QUEUES_INL_HPP
#endif

#include <algorithm>

#include "batch/flight-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace peterka::batch::HWY_NAMESPACE {

HWY_INLINE void push(Index lanes, Mask which, Crossings& list) {
    if (any(which)) list.size += compress(lanes, which, list.lane.data() + list.size);
}

HWY_INLINE void push(Index lanes, V end, V time, const Moment& m, Mask which, Queue& queue) {
    if (!any(which)) return;
    const std::size_t at = queue.size;
    queue.size += compress(lanes, which, queue.lane.data() + at);
    compress(end, which, queue.end.data() + at);
    compress(time, which, queue.time.data() + at);
    compress(m.delta, which, queue.delta.data() + at);
    compress(m.velocity, which, queue.velocity.data() + at);
    compress(m.sine, which, queue.sine.data() + at);
    compress(m.cosine, which, queue.cosine.data() + at);
}

// A vector of lanes, padded with copies of the first: these compute and store what it does, but must queue
// nothing.
struct Taken {
    Index lanes;
    Mask real;  // no padding
};
HWY_INLINE Taken take(Crossings& list) {
    const std::size_t count = std::min(width(), list.size);
    list.size -= count;
    std::int64_t* lane = list.lane.data() + list.size;
    std::fill(lane + count, lane + width(), lane[0]);
    return {load(lane), first(count)};
}

struct Waiting {
    Index lanes;
    Mask real;
    V end, time;
    Moment moment;
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
