// Contacts of any length: safe steps to the release and from maximum to maximum of the force, as in
// trajectory/first_crossing.hpp and largest_value.hpp.
#if defined(PETERKA_BATCH_LONG_CONTACT_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef PETERKA_BATCH_LONG_CONTACT_INL_HPP
#undef PETERKA_BATCH_LONG_CONTACT_INL_HPP
#else
#define PETERKA_BATCH_LONG_CONTACT_INL_HPP
#endif

#include "batch/contact-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace peterka::batch::HWY_NAMESPACE {

// The zero of sign times a derivative of the force (order 0 or 1), where it rises, in a contact of any length.
struct Sought {
    V time;
    ContactPoint point;
    Mask found;
    Mask unsure;
};
// Long for a single loop, whose parts would each need nearly all values of its step.
HWY_INLINE Sought seek(const auto& cells, const auto& contact, int order, V sign, V from,
                       const ContactPoint& start, V end, Mask which) {
    const V zero = all(0);
    const V w = cells.contact_frequency;
    const V power = order == 0 ? cells.contact_square : cells.contact_square * w;
    const V eta_power = order == 0 ? cells.drive : cells.drive * cells.eta;
    const V swing = contact.force_swing() * eta_power;

    V time = from;
    ContactPoint point = start;
    Mask active = which;
    Mask found = none();
    Mask unsure = none();
    V last = all(never);
    for (int n = 0; n < 60; ++n) {
        const Force f = contact.force(point);
        const V value = sign * (order == 0 ? f.value : f.slope);
        const V slope = sign * (order == 0 ? f.slope : f.curvature);
        const V curvature = sign * (order == 0 ? f.curvature : f.jerk);
        const V amplitude = contact.force_amplitude(point);
        const V most = mul_add(amplitude, power, swing);
        const V jerk = mul_add(amplitude, power * w, swing * cells.eta);
        const V below = min(value, zero);
        const auto root = [&](V bend) HWY_ATTR {
            const V discriminant = neg_mul_add(all(2) * bend, below, slope * slope);
            const V size = sqrt(max(discriminant, zero));
            const Mask rises = slope > zero;
            const V step = choose(rises, all(-2) * below, size - slope) / choose(rises, slope + size, bend);
            const Mask never_reaches = (discriminant < zero) | (~rises & (bend <= zero));
            return choose(never_reaches, all(never), step);
        };
        const V left = end - time;
        const V step = root(most);
        V better = step;
        V window = all(2) * step;
        Mask growing = every();
        for (int k = 0; k < 2; ++k) {
            const V local = mul_add(jerk, window, curvature);
            const V reach = min(root(local), window);
            growing = growing & (local < most);
            better = choose(growing, max(better, reach), better);
            growing = growing & (reach >= window);
            window = choose(growing, window * all(4), window);
        }
        const Mask absent = active & (better > left);

        // the slope keeps its sign up to twice the correction; the series is short enough where the correction
        // is small
        const Root near = taylor_root(value, slope, curvature, zero, zero);
        const V correction = near.time;
        const V size = near.reach;
        const Mask monotone = slope > all(4) * size * mul_add(jerk, all(2) * size, abs(curvature));
        const Mask small = (size * w < all(2e-4)) & (size * cells.eta < all(2e-4));
        const Mask arrived = active & ~absent & monotone & small & (correction <= left);
        // Newton's step, where it is safe, converges faster than the bound's
        const Mask newton = monotone & (correction <= left);
        const Mask moves = newton | (better * w > all(1e-9));
        const Mask stuck = ~(arrived | absent | moves) & active;
        found = found | arrived;
        unsure = unsure | stuck;
        last = choose(arrived, correction, last);
        active = ~(arrived | absent | stuck) & active;
        if (!any(active)) break;
        time = choose(active, time + choose(newton, correction, better), time);
        const ContactPoint moved = contact.at(time);
        point = choose(active, moved, point);
    }
    const ContactPoint finish = contact.next(point, last);
    time = choose(found, time + last, time);
    point = choose(found, finish, point);
    return {time, point, found, unsure | active};
}

// Largest force of a contact up to its end: its maxima one after another, as long as the rest of the transient
// could still exceed the largest seen (as in trajectory/largest_value.hpp).
HWY_INLINE Peak long_peak(const auto& cells, const auto& contact, V end, Mask which) {
    const V highest = contact.static_force() + contact.force_swing();
    V time = all(0);
    ContactPoint point = contact.start();
    Force f = contact.force(point);
    V largest = f.value;
    V sign = choose(f.slope > all(0), all(-1), all(1));  // of the slope whose rise is sought
    Mask active = which;
    Mask unsure = none();
    for (int n = 0; n < 64; ++n) {
        active = active & (highest + contact.force_amplitude(point) > largest);
        if (!any(active)) break;
        const Sought extremum = seek(cells, contact, 1, sign, time, point, end, active);
        unsure = unsure | extremum.unsure;
        active = active & extremum.found;
        time = choose(active, extremum.time, time);
        point = choose(active, extremum.point, point);
        f = contact.force(point);
        largest = choose(active, max(largest, f.value), largest);
        sign = choose(active, -sign, sign);
    }
    const V last = contact.force(contact.at(end)).value;
    return {max(largest, last), ~(unsure | active)};
}

}  // namespace peterka::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
