#include "certificate/chatter.hpp"

#include <algorithm>
#include <cmath>

namespace peterka::certificate {
namespace {

const Vector<Interval> at_rest{Interval(0), Interval(0)};

Interval pressing(const Springs<Interval>& springs, const Interval& sine) {
    return springs.flight.acceleration(at_rest, sine);
}

// The s at which a(s) = 0, in doubles.
double zero_of_pressing(const Springs<Interval>& springs) {
    double low = -1;
    double high = 1;
    for (int halvings = 0; halvings < 60; ++halvings) {
        const double middle = 0.5 * (low + high);
        (pressing(springs, Interval(middle)).middle() > 0 ? high : low) = middle;
    }
    return 0.5 * (low + high);
}

// The time near this one at which a passes through 0 [tau], by Newton's interval method.
std::optional<Interval> zero_of_pressing(const Springs<Interval>& springs, double near) {
    const Phase<Interval>& phase = springs.flight;
    const Interval value = pressing(springs, sine_cosine(phase.frequency() * Interval(near)).sine);
    double radius = 1e-14;
    for (int tries = 0; tries < 20; ++tries, radius *= 4) {
        const Interval box = around(near, radius);
        const Interval slope = phase.jerk(at_rest, Interval(0), sine_cosine(phase.frequency() * box));
        const Interval image = Interval(near) - value / slope;
        if (image.inside(box)) return image;
    }
    return std::nullopt;
}

// From an impact to the end of the orbit's last stretch of pressing.
Interval time_to_lift_off(const Springs<Interval>& springs, const EventChain& chain,
                          const Place<Interval>& impact, std::int64_t cycle) {
    const auto cycles = static_cast<double>(chain.period - cycle);
    return springs.lift_off - impact.time + Interval(cycles) * springs.rig.period;
}

bool is_near(const Vector<double>& state, const Springs<double>& springs, const StroboscopicOrbit& orbit,
             double distance) {
    return std::abs(state.position + springs.rig.gap - orbit.displacement) <= distance &&
           std::abs(state.velocity - orbit.velocity) <= distance;
}

}  // namespace

Interval acceleration_near_stop(const Phase<Interval>& phase, const Interval& pressing, const Interval& speed,
                                const Interval& depth) {
    const Interval slope(phase.largest_cubic_slope((abs(phase.gap()) + depth).hi));
    const Interval least = Interval(pressing.lo) - phase.damping() * speed - slope * depth;
    const Interval most = Interval(pressing.hi) + phase.damping() * speed + (phase.stiffness() + slope) * depth;
    return {least.lo, most.hi};
}

bool find_lift_off(Springs<Interval>& springs) {
    const bool changes_sign =
        pressing(springs, Interval(-1)).negative() && pressing(springs, Interval(1)).positive();
    if (!changes_sign || !springs.flight.pressing_rises()) return false;
    const double theta = pi.middle() - std::asin(zero_of_pressing(springs));
    const std::optional<Interval> time = zero_of_pressing(springs, theta / springs.rig.frequency.middle());
    if (time) springs.lift_off = *time;
    return time.has_value();
}

std::optional<EventChain> find_chatter(const Springs<Interval>& springs, const Springs<double>& approximate,
                                       const StroboscopicOrbit& orbit) {
    constexpr double near = 0.02;  // the engine may have left a cubic spring out
    const double period = approximate.rig.period;
    const double end = approximate.lift_off + static_cast<double>(orbit.period) * period;
    EventChain chain{orbit.period, {{EventKind::lift_off, 0, approximate.lift_off, 0}}};
    Walk walk = Walk::after(approximate, chain.events[0]);
    bool meets_claim = false;
    double phase_zero = period;
    Event event;
    while (chain.events.size() < most_events) {
        const Walk::End how = walk.go_on(std::min(phase_zero, end), event);
        if (how == Walk::End::none || walk.time() >= end) return std::nullopt;
        if (how == Walk::End::time) {
            meets_claim = meets_claim || is_near(walk.state(), approximate, orbit, near);
            phase_zero += period;
            continue;
        }
        sort_into_cycle(event, period);
        chain.events.push_back(event);
        const Place<Interval> impact{Interval(event.time), Interval(event.along)};
        if (!speed_before_rest(springs, impact, time_to_lift_off(springs, chain, impact, event.cycle)))
            continue;
        // From now on it stays near the stop.
        const double about = near + 2 * approximate.rig.restitution * event.along;
        meets_claim = meets_claim || (phase_zero < end && is_near({0, 0}, approximate, orbit, about));
        return meets_claim && refine(approximate, chain) ? std::optional(chain) : std::nullopt;
    }
    return std::nullopt;
}

std::optional<double> speed_before_rest(const Springs<Interval>& springs, const Place<Interval>& impact,
                                        const Interval& left) {
    const Phase<Interval>& phase = springs.flight;
    const Interval r = springs.rig.restitution;
    const Interval w((r * impact.along).hi);
    const Interval now = phase.frequency() * impact.time;
    const bool is_last_stretch = left.positive() && (left - springs.rig.period).negative();
    if (!is_last_stretch || !pressing(springs, sine_cosine(now).sine).positive()) return std::nullopt;
    if (r.hi == 0) return 0;  // at rest at once
    double time = 0;
    for (int tries = 0; tries < 12; ++tries) {
        if (!(Interval(time) - left).negative()) return std::nullopt;
        const Interval a = pressing(springs, sine_cosine(now + phase.frequency() * Interval(0, time)).sine);
        if (!a.positive()) return std::nullopt;
        const Interval v = Interval(2) * w;
        const Interval d = square(w) / Interval(a.lo);
        const Interval near = acceleration_near_stop(phase, a, v, d);
        if (!near.positive()) return std::nullopt;
        const Interval alpha(near.lo);
        const Interval beta(near.hi);
        const Interval growth = sqrt(beta / alpha);
        const Interval shrinks = Interval(1) - r * growth;
        const bool is_bounded =
            (w * growth - v).negative() && (square(w) / (Interval(2) * alpha) - d).negative();
        if (!is_bounded || !shrinks.positive()) return std::nullopt;
        const Interval takes = Interval(2) * w / (alpha * shrinks);
        if (takes.hi <= time) return (w * growth).hi;
        time = 1.05 * takes.hi;
    }
    return std::nullopt;
}

std::optional<double> comes_to_rest(const Springs<Interval>& springs, const EventChain& chain,
                                    const std::vector<Place<Interval>>& places) {
    const Place<Interval>& last = places.back();
    return speed_before_rest(springs, last, time_to_lift_off(springs, chain, last, chain.events.back().cycle));
}

std::int64_t impacts_with_chatter(const Springs<Interval>& springs, const EventChain& chain,
                                  const std::vector<Place<Interval>>& places) {
    const double rising = std::asin(zero_of_pressing(springs)) / springs.rig.frequency.middle();
    const std::optional<Interval> begins = zero_of_pressing(springs, rising);
    if (!begins) return 0;
    const Interval stretch = springs.lift_off - *begins;
    std::int64_t impacts = 1;
    for (std::size_t i = 1; i < places.size(); ++i) {
        const Interval left = time_to_lift_off(springs, chain, places[i], chain.events[i].cycle);
        if (!left.apart(stretch)) return 0;
        impacts += left.lo > stretch.hi ? 1 : 0;
    }
    return impacts;
}

}  // namespace peterka::certificate
