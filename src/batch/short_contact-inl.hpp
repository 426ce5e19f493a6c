// Impacts that are short compared with the forcing (rig.hpp): Newton's method from the times of a constant
// acceleration. Typically one evaluation each for the release and the peak, and no transcendental functions
// except the forcing's.
#if defined(PETERKA_BATCH_SHORT_CONTACT_INL_HPP) == defined(HWY_TARGET_TOGGLE)
#ifdef PETERKA_BATCH_SHORT_CONTACT_INL_HPP
#undef PETERKA_BATCH_SHORT_CONTACT_INL_HPP
#else
#define PETERKA_BATCH_SHORT_CONTACT_INL_HPP
#endif

#include "batch/contact-inl.hpp"

HWY_BEFORE_NAMESPACE();
namespace peterka::batch::HWY_NAMESPACE {

HWY_INLINE V guess(const std::array<double, Rig::guess_terms>& shift, V x) {
    V t = all(shift[Rig::guess_terms - 1]);
    for (std::size_t n = Rig::guess_terms - 1; n-- > 0;) t = mul_add(t, x, all(shift[n]));
    return t;
}

// The pull of forcing and springs half-way through an unforced contact: its mean, to first order. springs:
// their pull at the stop.
HWY_INLINE V mean_pull(const Rig& rig, const auto& cells, const Moments& touch, V springs) {
    const V sine = mul_add(cells.eta * all(rig.exit_time / 2), touch.cosine, touch.sine);
    return mul_sub(cells.drive, sine, springs);
}

struct Release {
    V time;  // since the contact began
    ContactPoint point;
    Mask sure;
};

// End of a contact whose force surely has the unforced shape (rig.hpp). pull: the forcing's acceleration over
// speed, over pull_scale.
HWY_INLINE Release short_release(const Rig& rig, const auto& contact, V pull, Mask which) {
    const V close = all(2.5e-3 / rig.contact_frequency);  // its fifth power, over 120, is neglected
    const V earliest = all(rig.falls_from - rig.exit_time);
    const V latest = all(rig.latest_exit - rig.exit_time);
    V time = max(min(guess(rig.exit_shift, pull), latest), earliest);
    ContactPoint point = contact.near(rig.exit_time, rig.exit_flow, time);
    Force f = contact.force(point);
    Root root = taylor_root(f.value, f.slope, f.curvature, f.jerk, f.snap);
    V t = root.time;
    Mask sure = root.reach <= close;
    for (int n = 0; n < 6 && any(~sure & which); ++n) {
        time = choose(sure, time, max(min(time + t, latest), earliest));
        point = choose(sure, point, contact.near(rig.exit_time, rig.exit_flow, time));
        f = contact.force(point);
        root = taylor_root(f.value, f.slope, f.curvature, f.jerk, f.snap);
        t = choose(sure, t, root.time);
        sure = sure | (root.reach <= close);
    }
    time = time + t;
    const Mask inside = (time > earliest) & (time < latest);
    return {all(rig.exit_time) + time, contact.next(point, t), sure & inside};
}

struct ShortPeak {
    V force;
    V time;  // since the contact began
    Mask sure;
};

// Largest force of such a contact.
HWY_INLINE ShortPeak short_peak(const Rig& rig, const auto& contact, V pull, Mask which) {
    const Force first = contact.force(contact.start());
    if (rig.falls_from == 0) return {first.value, all(0), every()};
    const Mask falls = first.slope <= all(0);
    const V close = all(4e-3 / rig.contact_frequency);  // an error of the time has a quadratic effect
    const V earliest = all(-rig.peak_time);
    const V latest = all(rig.falls_from - rig.peak_time);
    V time = max(min(guess(rig.peak_shift, pull), latest), earliest);
    Force f = contact.force(contact.near(rig.peak_time, rig.peak_flow, time));
    Root root = taylor_root(f.slope, f.curvature, f.jerk, f.snap, all(0));
    V t = root.time;
    Mask sure = falls | (root.reach <= close);
    for (int n = 0; n < 6 && any(~sure & which); ++n) {
        time = choose(sure, time, max(min(time + t, latest), earliest));
        f = choose(sure, f, contact.force(contact.near(rig.peak_time, rig.peak_flow, time)));
        root = taylor_root(f.slope, f.curvature, f.jerk, f.snap, all(0));
        t = choose(sure, t, root.time);
        sure = sure | (root.reach <= close);
    }
    const V high = mul_add(t, f.snap * all(1.0 / 24), f.jerk * all(1.0 / 6));
    const V third = mul_add(t, high, f.curvature * all(0.5));
    const V top = mul_add(t, mul_add(t, third, f.slope), f.value);
    return {choose(falls, first.value, max(first.value, top)),
            choose(falls, all(0), all(rig.peak_time) + time + t), sure};
}

}  // namespace peterka::batch::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
