// The first time at which a signal rises through zero, with a guarantee that none is missed.
//
// From a point with s <= 0 and a bound M on s'' up to h, s(t + h) <= s + s' h + M h^2/2, so the parabola's root
// is a step that cannot pass the crossing. M is a bound for all later times, or the value that s'' can reach
// within the step at the largest s''' of all later times. Such steps converge to the crossing from below
// (quadratically, like Newton's method); short hops and grazing maxima cannot hide between samples, because
// there are no samples. Once the slope is known to keep its sign up to the crossing, the same step with the
// true s'' in place of M refines it.
#pragma once

#include <cmath>
#include <limits>
#include <optional>

#include "motion/signal.hpp"

namespace peterka::trajectory {

using motion::Leg;
using motion::Moment;
using motion::Probe;

template <class Real>
struct Crossing {
    // How the search ended.
    enum class Ending { crossing, none, exhausted, not_finite };
    Ending ending = Ending::none;
    Moment<Real> moment;  // the crossing, or the last point evaluated
    int evaluations = 0;
};

// Root of s + r h + M h^2/2 next to h = 0, on the side where s rises; for s <= 0 with M > 0 the one at h >= 0.
template <class Real>
Real parabola_step(Real value, Real slope, Real curvature) {
    const Real root = std::sqrt(std::max(slope * slope - 2 * curvature * value, Real(0)));
    return slope > 0 ? -2 * value / (slope + root) : (root - slope) / curvature;
}

// The longest step that certainly doesn't pass the crossing.
template <class Real>
Real safe_step(Real value, Real slope, Real curvature, const typename Probe<Real>::Bounds& bounds) {
    Real step = parabola_step(value, slope, bounds.curvature);
    Real window = 2 * step;
    while (window > 0) {
        const Real local = curvature + bounds.jerk * window;
        if (!(local < bounds.curvature)) return step;
        const bool never = slope * slope < 2 * local * value || (slope <= 0 && local <= 0);
        const Real reach = never ? window : parabola_step(value, slope, local);
        if (reach < window) return std::max(step, reach);
        step = window;
        window *= 4;
    }
    return step;
}

// Newton's method with curvature, where the slope keeps its sign up to the crossing. False if it doesn't
// converge.
template <class Real>
bool polish(const Leg<Real>& leg, const Probe<Real>& probe, Real step, Crossing<Real>& search) {
    constexpr Real epsilon = std::numeric_limits<Real>::epsilon();
    Moment<Real>& m = search.moment;
    for (Real last = step;;) {
        const Real value = probe.value(m);
        const Real correction = parabola_step(value, probe.slope(m), probe.curvature(m));
        if (!(std::abs(correction) < last / 2)) return false;
        last = std::abs(correction);
        if (last <= 2 * epsilon * m.time) return true;
        m = leg.at(m.time + correction);
        ++search.evaluations;
        if (std::abs(value) <= probe.resolution(m)) return true;
    }
}

// Searches (from.time, end] of the leg. Values within the rounding error of zero count as zero: a start there
// is left behind, and a hop that rises no higher is ignored.
template <class Real>
Crossing<Real> first_crossing(const Leg<Real>& leg, const Probe<Real>& probe, const Moment<Real>& from,
                              Real end) {
    constexpr Real epsilon = std::numeric_limits<Real>::epsilon();
    constexpr int budget = 100'000;  // far beyond any physical leg; exhausting it becomes the cell's status
    using Ending = typename Crossing<Real>::Ending;

    Crossing<Real> search{Ending::none, from, 0};
    Moment<Real>& m = search.moment;
    bool may_polish = true;
    while (search.evaluations < budget) {
        const Real value = probe.value(m);
        const Real slope = probe.slope(m);
        const auto bounds = probe.bounds(m);
        const Real bound = bounds.curvature;
        const Real zero = probe.resolution(m);
        if (!std::isfinite(value) || !std::isfinite(slope) || !std::isfinite(bound)) {
            search.ending = Ending::not_finite;
            return search;
        }
        const bool rises = slope > 0 && slope * slope > 2 * bound * zero;
        if (value >= -zero && rises && m.time > from.time) {
            search.ending = Ending::crossing;
            return search;
        }
        if (bound == 0) return search;  // at rest for ever
        Real step = safe_step(std::min(value, -zero), slope, probe.curvature(m), bounds);
        if (step <= 2 * epsilon * m.time) {  // below the resolution of time
            if (rises) {
                search.ending = Ending::crossing;
                return search;
            }
            // where a leg starts with value and slope 0, any step is better than none
            step = m.time > 0 ? 4 * epsilon * m.time : std::max(step, epsilon * leg.motion().short_time());
        }
        if (m.time + step > end) return search;

        const bool monotone = slope > 4 * bound * step;
        m = leg.at(m.time + step);
        ++search.evaluations;
        if (!monotone || !may_polish) continue;
        const Moment<Real> safe = m;
        if (polish(leg, probe, step, search)) {
            search.ending = m.time <= end ? Ending::crossing : Ending::none;
            return search;
        }
        m = safe;
        may_polish = false;
    }
    search.ending = Ending::exhausted;
    return search;
}

}  // namespace peterka::trajectory
