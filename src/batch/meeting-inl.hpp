// When a flight meets the stop, with proof that it is for the first time.
#if defined(PETERKA_BATCH_MEETING_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef PETERKA_BATCH_MEETING_INL_HPP
#undef PETERKA_BATCH_MEETING_INL_HPP
#else
#define PETERKA_BATCH_MEETING_INL_HPP
#endif

#include "batch/flight-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace peterka::batch::HWY_NAMESPACE {

// The zero of a quantity that rises along a flight, a short time away, by its Taylor series.
struct Meeting {
    V time;     // from now
    Mask sure;  // the series resolves it
};
HWY_INLINE Meeting meet(const auto& cells, const Rise& rise) {
    const V inverse = all(1) / rise.slope;
    const V first = -rise.value * inverse;
    const V second = rise.second * inverse * all(0.5);
    const V third = rise.third * inverse * all(1.0 / 6);
    const V fourth = rise.fourth * inverse * all(1.0 / 24);
    V t = first;
    for (int n = 0; n < 3; ++n) {
        t = neg_mul_add(t * t, mul_add(t, mul_add(t, fourth, third), second), first);
    }
    // truncation omits t^5/120 of the fifth derivative, and the fourth power of second t
    const V reach = max(abs(t), abs(first)) * max(max(cells.eta, cells.frequency), all(8) * abs(second));
    return {t, (reach < all(1e-3)) & (rise.slope > all(0))};
}
// At the stop, delta = 0.
HWY_INLINE Moments meeting_moment(const auto& cells, const Moments& m, const Derivatives& d, V t) {
    const V high = mul_add(t * all(1.0 / 6), d.fourth, d.third * all(0.5));
    const V x = cells.eta * t;
    const V z = x * x;
    const V sine = x * mul_add(z, all(-1.0 / 6), all(1));
    const V cosine = mul_add(z, mul_add(z, all(1.0 / 24), all(-0.5)), all(1));
    const SineCosine phase = turned(m.sine, m.cosine, {sine, cosine});
    return {all(0), mul_add(t, mul_add(t, high, d.second), m.velocity), phase.sine, phase.cosine};
}

struct MeetingMoment {
    V time;  // since the stretch began
    Moments moment;
    Mask found;   // reaches zero there, for the first time
    Mask unsure;  // neither found nor surely absent
};

// For a flight that starts below zero and ends above it one grid step later.
HWY_INLINE MeetingMoment first_meeting(const auto& cells, const Moments& start, V delta1, V velocity1,
                                       V margin) {
    // guess: Newton's method on the cubic through both ends
    const V h = cells.step;
    const V rise = delta1 - start.delta;
    const V slope0 = h * start.velocity;
    const V slope1 = h * velocity1;
    const V third = slope0 + slope1 - all(2) * rise;
    const V second = all(3) * rise - all(2) * slope0 - slope1;
    V s = -start.delta / rise;
    for (int n = 0; n < 2; ++n) {
        const V value = mul_add(s, mul_add(s, mul_add(s, third, second), slope0), start.delta);
        const V slope = mul_add(s, mul_add(s, all(3) * third, all(2) * second), slope0);
        const V bend = mul_add(s, all(3) * third, second);
        const V inverse = all(1) / slope;
        const V newton = -value * inverse;
        const V halley = neg_mul_add(newton * newton, bend * inverse, newton);
        s = min(max(s + halley, all(0)), all(1));
    }

    const Flight flight(cells, start);
    V time = s * h;
    Moments m = flight.soon(time);
    Derivatives d = derivatives(cells, m);
    Meeting meeting = meet(cells, rise_of_position(m, d));
    for (int n = 0; n < 3 && !everywhere(meeting.sure); ++n) {
        const V again = min(max(time + meeting.time, all(0)), h);
        time = choose(meeting.sure, time, again);
        m = flight.soon(time);
        d = derivatives(cells, m);
        const Meeting next = meet(cells, rise_of_position(m, d));
        meeting = {choose(meeting.sure, meeting.time, next.time), meeting.sure | next.sure};
    }
    const Moments end = meeting_moment(cells, m, d, meeting.time);
    time = time + meeting.time;

    // proof that it is the first: the hull of the flight up to there stays below zero
    const V part = time * cells.per_step;
    const V square = part * part;
    const Hull hull(start.delta, start.velocity, all(0), end.velocity, time, margin * square * square);
    const Mask below = max(max(hull.b1, hull.b2), hull.b3) <= all(0);
    const Mask found = meeting.sure & below & (end.velocity > all(0));
    return {time, end, found, ~found};
}

// Any rise from below zero along a flight, over a stretch of at most a few steps. From a point with s <= 0 and
// a bound A on s'', the parabola's root is a step that cannot pass the crossing (as in
// trajectory/first_crossing.hpp); A is the largest s'' possible in a window, from its present value, its slope,
// and a bound on its second derivative. rise_of(m, d): s at a moment; land(m, d, t): the moment a time t later,
// where s is zero.
template <class RiseOf, class Land>
HWY_INLINE MeetingMoment seek(const auto& cells, const Moments& start, V length, V fourth_derivative,
                              Mask which, RiseOf rise_of, Land land) {
    const V zero = all(0);
    const Flight flight(cells, start);
    V time = zero;
    Moments m = start;
    V end_time = zero;
    Moments end = start;
    Mask active = which;
    Mask found = none();
    Mask unsure = none();
    for (int n = 0; n < 40; ++n) {
        const Derivatives d = derivatives(cells, m);
        const Rise s = rise_of(m, d);
        const V below = min(s.value, zero);
        // the parabola's root for a window, or `otherwise` if it has none
        const auto bound = [&](V window) HWY_ATTR {
            const V bend = mul_add(window * all(0.5), fourth_derivative, s.third);
            return max(s.second, mul_add(window, bend, s.second));
        };
        const auto root = [&](V curvature, V otherwise) HWY_ATTR {
            const V discriminant = neg_mul_add(all(2) * curvature, below, s.slope * s.slope);
            const V size = sqrt(max(discriminant, zero));
            const Mask rises = s.slope > zero;
            const V step =
                choose(rises, all(-2) * below, size - s.slope) / choose(rises, s.slope + size, curvature);
            const Mask never_reaches = (discriminant < zero) | (~rises & (curvature <= zero));
            return choose(never_reaches, otherwise, step);
        };
        const V left = length - time;
        const V step = root(bound(left), all(never));
        const Mask absent = active & (step > left);

        const V window = min(all(2) * step, left);
        const V steepest = bound(window);
        const V better = max(step, min(root(steepest, window), window));

        const Meeting meeting = meet(cells, s);
        const V bending = max(abs(s.second), abs(steepest));
        const Mask monotone = s.slope > all(4) * bending * abs(meeting.time);
        const Mask within = abs(meeting.time) <= window;
        const Mask arrived = active & ~absent & meeting.sure & monotone & within;
        if (any(arrived)) {
            end = choose(arrived, land(m, d, meeting.time), end);
            end_time = choose(arrived, time + meeting.time, end_time);
            found = found | arrived;
        }
        active = ~(arrived | absent) & active;
        const Mask stuck = ~(better > all(1e-9)) & active;  // near grazing
        unsure = unsure | stuck;
        active = ~stuck & active;
        if (!any(active)) break;
        time = choose(active, time + better, time);
        m = choose(active, flight.at(time), m);
    }
    return {end_time, end, found, unsure | active};
}
// The hammer's next touch.
HWY_INLINE MeetingMoment seek_touch(const auto& cells, const Moments& start, V length, V fourth_derivative,
                                    Mask which) {
    return seek(
        cells, start, length, fourth_derivative, which,
        [](const Moments& m, const Derivatives& d) HWY_ATTR { return rise_of_position(m, d); },
        [&](const Moments& m, const Derivatives& d, V t) HWY_ATTR { return meeting_moment(cells, m, d, t); });
}
// From where the stop does not press: the next moment at which it would, if that is still reached.
HWY_INLINE MeetingMoment seek_force(const auto& cells, const Moments& start, V length, V fourth_derivative,
                                    Mask which) {
    const V fourth = fourth_derivative * mul_add(all(cells.rig.lag), max(cells.eta, cells.frequency), all(1));
    return seek(
        cells, start, length, fourth, which,
        [&](const Moments& m, const Derivatives& d) HWY_ATTR { return rise_of_force(cells, m, d); },
        [&](const Moments& m, const Derivatives& d, V t) HWY_ATTR {
            const Moments end = meeting_moment(cells, m, d, t);
            return Moments{all(-cells.rig.lag) * end.velocity, end.velocity, end.sine, end.cosine};
        });
}

}  // namespace peterka::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
