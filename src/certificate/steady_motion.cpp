#include "certificate/steady_motion.hpp"

#include <algorithm>

#include "certificate/leg_proof.hpp"
#include "certificate/stability.hpp"

namespace peterka::certificate {
namespace {

constexpr int most_steps_to_settle = 20'000;

// Mean and amplitude of a delta + b delta' along the linear response.
struct Swing {
    Interval mean;
    Interval amplitude;
};

Swing swing_of(const Phase<Interval>& phase, const Interval& a, const Interval& b) {
    const Interval sine = a * phase.real() - b * phase.frequency() * phase.imaginary();
    const Interval cosine = a * phase.imaginary() + b * phase.frequency() * phase.real();
    return {a * phase.rest(), sqrt(square(sine) + square(cosine))};
}

// The swing of the force or, in flight, of the penetration.
Swing swing_of(const Springs<Interval>& springs, bool presses) {
    const Phase<Interval>& phase = springs.phase(presses);
    return presses ? swing_of(phase, springs.rig.stiffness, springs.rig.damping)
                   : swing_of(phase, Interval(1), Interval(0));
}

// Upper bounds of int |h| dt and int |h'| dt. With b = c/2: either h is exp(-b t) sin(nu t)/nu, with int |h| dt
// = coth(pi b/(2 nu))/K, or h does not change its sign; and either |h'| is at most exp(-b t) sqrt(K)/nu, or h
// rises once, to at most 1/b, and falls.
struct Gain {
    Interval of_value;
    Interval of_rate;
};

Gain gain_of(const Phase<Interval>& phase) {
    const Interval b = phase.damping() / Interval(2);
    const Interval stiffness = phase.stiffness();
    const Interval square_of_rate = stiffness - square(b);
    if (square_of_rate.negative()) return {Interval(1) / stiffness, Interval(2) / b};
    const Interval rate = sqrt(square_of_rate);
    const Interval decay = exp(-(pi * b / rate));
    return {(Interval(1) + decay) / (Interval(1) - decay) / stiffness, sqrt(stiffness) / rate / b};
}

// The largest |u| of a motion at most `shift` from the linear response.
double reach_of_motion(const Phase<Interval>& phase, double shift) {
    const Interval middle = abs(phase.rest() + phase.gap());
    return (middle + Interval(phase.swing()) + Interval(shift)).hi;
}

// Whether all motions with |u| up to this bound approach each other.
bool contracts(const Phase<Interval>& phase, double u) {
    const Interval slope(phase.largest_cubic_slope(u));
    const Interval c = phase.damping();
    return (c - slope).positive() && (c * phase.stiffness() - slope * (Interval(1) + c)).positive();
}

// rho, the largest distance from the linear response of springs with a cubic term; NaN if none is proved.
double shift_of(const Phase<Interval>& phase, const Gain& gain) {
    double shift = 0;
    for (int tries = 0; tries < 20; ++tries) {
        const double u = reach_of_motion(phase, shift);
        const Interval image = gain.of_value * phase.largest_cubic(u);
        if (image.hi <= shift) {
            const bool is_contraction = (gain.of_value * phase.largest_cubic_slope(u)).hi < 1;
            return is_contraction ? shift : nothing().lo;
        }
        shift = 1.05 * image.hi;
    }
    return nothing().lo;
}

// On a rigid stop the hammer rests while its acceleration there, a(s) with s = sin(theta), is positive. Where a
// rises with s, its bounds are those at s = -1 and 1. With r < 1 a neighbouring motion comes to rest, too, in a
// series of bounces (C. Budd and F. Dux, Phil. Trans. R. Soc. A 347, 1994): its multipliers are 0.
std::optional<SteadyMotion> rest_on_rigid_stop(const Springs<Interval>& springs) {
    const Phase<Interval>& phase = springs.flight;
    const Vector<Interval> at_rest{Interval(0), Interval(0)};
    if (!phase.pressing_rises()) return std::nullopt;
    SteadyMotion motion;
    motion.room = phase.acceleration(at_rest, Interval(-1)).lo;
    if (!(motion.room > 0)) return std::nullopt;
    motion.force = phase.acceleration(at_rest, Interval(1));
    motion.margin = (Interval(1) - springs.rig.restitution).positive() ? 1 : 0;
    return motion;
}

}  // namespace

std::optional<SteadyMotion> steady_motion(const Springs<Interval>& springs, bool presses) {
    if (presses && springs.rig.rigid) return rest_on_rigid_stop(springs);
    const Phase<Interval>& phase = springs.phase(presses);
    const Swing swing = swing_of(springs, presses);
    SteadyMotion motion;
    Interval spread(0);
    if (!phase.is_linear()) {
        const Gain gain = gain_of(phase);
        motion.shift = shift_of(phase, gain);
        motion.rate_shift = (gain.of_rate * phase.largest_cubic(reach_of_motion(phase, motion.shift))).hi;
        spread = presses ? springs.rig.stiffness * motion.shift + springs.rig.damping * motion.rate_shift
                         : Interval(motion.shift);
    }
    motion.reach = reach_of_motion(phase, motion.shift);
    motion.room = ((presses ? swing.mean : -swing.mean) - swing.amplitude - spread).lo;
    if (!(motion.room > 0)) return std::nullopt;
    const Matrix<Interval> flow = phase.changed(phase.flow(springs.rig.period), springs.rig.period,
                                                phase.largest_cubic_slope(motion.reach));
    motion.margin = stability_margin(exp(-(phase.damping() * springs.rig.period)), flow.a + flow.d);
    if (!contracts(phase, motion.reach)) motion.margin = 0;
    if (presses) motion.force = swing.mean + swing.amplitude + Interval(-spread.hi, spread.hi);
    return motion;
}

// V never increases; once it is too small for the signal to change its sign, it never does.
bool keeps_to_phase(const Springs<Interval>& springs, bool presses, const SteadyMotion& motion,
                    const Leg<Interval>& leg, std::optional<EventKind> from) {
    const Phase<Interval>& phase = springs.phase(presses);
    const Interval half = phase.damping() / Interval(2);
    const Interval stiffness = phase.stiffness() + square(half);  // K + c^2/4
    const auto stays = [&](double offset) {
        const Vector<Interval> left = leg.at(Interval(offset)).decaying;
        const Interval w = left.position + Interval(-motion.shift, motion.shift);
        const Interval rate = left.velocity + Interval(-motion.rate_shift, motion.rate_shift);
        const Interval length = sqrt(square(rate + half * w) + stiffness * square(w));
        const Interval largest = length / sqrt(stiffness);  // bound of |w| from now on
        const Interval fastest = length + half * largest;   // bound of |w'|
        const Interval change =
            presses ? springs.rig.stiffness * largest + springs.rig.damping * fastest : largest;
        return change.hi < motion.room && contracts(phase, (Interval(motion.reach) + largest).hi);
    };
    if (!from && presses && !leg.start().state.position.positive()) return false;
    March march(springs, leg, presses);
    double looked = 0;
    for (int steps = 0; steps < most_steps_to_settle; ++steps) {
        if (!(steps == 0 ? march.begin(from, 1e6) : march.step(1e6))) return false;
        if (march.offset() < looked + springs.rig.period.hi) continue;
        looked = march.offset();
        if (stays(looked)) return true;
    }
    return false;
}

}  // namespace peterka::certificate
