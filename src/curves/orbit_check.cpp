#include "curves/orbit_check.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <optional>

#include "curves/motion_events.hpp"

namespace peterka::curves {

namespace {

// One leg of an orbit as a motion in time.
struct LegInTime {
    const PlacedRig* rig;
    const OrbitPoint* point;
    std::size_t event;
    double from;
    double to;
    State<double> start;

    [[nodiscard]] bool presses() const { return point->orbit.events[event].presses; }
    [[nodiscard]] State<double> at(double time) const {
        return rig->state_in_leg(presses(), from, start, time);
    }
    // f and df/dtau, as if the stop pressed.
    [[nodiscard]] State<double> force(double time, const State<double>& x) const {
        const State<double> slope = rig->slope(presses(), time, x);
        return {rig->force(x), rig->force(slope)};
    }
};

LegInTime leg_in_time(const PlacedRig& rig, const OrbitPoint& point, std::size_t i) {
    const Event& from = point.orbit.events[i];
    const bool last = i + 1 == point.orbit.events.size();
    const double to = point.orbit.after(i).time + (last ? rig.duration_of(point.orbit.period) : 0);
    return {&rig, &point, i, from.time, to, rig.departure(from)};
}

// Sampling of a leg: 24 times per oscillation of the forcing and of the leg itself, the latter only until it
// has decayed.
constexpr double looks_in_a_turn = 24;
constexpr int most_looks = 4000;

double next_look(const LegInTime& leg, double time) {
    const double b = leg.rig->damping(leg.presses());
    const double natural = std::sqrt(leg.rig->stiffness(leg.presses()));
    const bool rings = !leg.presses() || b * (time - leg.from) < 25;
    const double fastest = std::max(leg.rig->frequency(), rings ? natural : 1.0);
    return time +
           std::max(2 * std::numbers::pi / (looks_in_a_turn * fastest), (leg.to - leg.from) / most_looks);
}

using Quantity = std::function<double(double time, const State<double>& x)>;

// Where a slope changes its sign between two times.
double zero_between(const LegInTime& leg, double low, double high, const Quantity& slope) {
    const bool rises = slope(high, leg.at(high)) > 0;
    for (int halving = 0; halving < 60 && high - low > 1e-13 * (1 + std::abs(high)); ++halving) {
        const double middle = (low + high) / 2;
        ((slope(middle, leg.at(middle)) > 0) == rises ? high : low) = middle;
    }
    return (low + high) / 2;
}

// Calls `look` at each time at which a slope falls through 0 within a leg.
void each_maximum(const LegInTime& leg, const Quantity& slope,
                  const std::function<void(double time, const State<double>& x)>& look) {
    double before = leg.from;
    bool rises = slope(before, leg.at(before)) > 0;
    while (before < leg.to) {
        const double now = std::min(next_look(leg, before), leg.to);
        const bool rises_now = slope(now, leg.at(now)) > 0;
        if (rises && !rises_now) {
            const double top = zero_between(leg, before, now, slope);
            look(top, leg.at(top));
        }
        rises = rises_now;
        before = now;
    }
}

// Near its ends a leg may, by rounding, meet its own first and last events.
double margin_of(const LegInTime& leg) {
    return 1e-6 * (leg.to - leg.from);
}

// The first event of the true motion before the leg ends.
std::optional<Event> first_in(const LegInTime& leg) {
    return first_event_after(*leg.rig, leg.point->orbit.events[leg.event], leg.to - leg.from - margin_of(leg));
}

// The time at which a flight continued beyond the stop reaches furthest.
double top_after(const LegInTime& leg, const Event& touch) {
    const auto velocity = [](double, const State<double>& x) { return x[1]; };
    double before = touch.time;
    double step = 1e-3 * (leg.to - leg.from);
    const double falling = -leg.rig->slope(false, before, {0, touch.velocity})[1];
    if (falling > 0) step = std::min(step, touch.velocity / falling / 2);
    for (double now = before + step; now < leg.to; now = before + step) {
        if (leg.at(now)[1] <= 0) return zero_between(leg, before, now, velocity);
        before = now;
        step *= 1.5;
    }
    return leg.to;
}

// A flight may lie beyond the stop until it has left it and, by rounding, at its very ends.
OrbitFault fault_of_flight(const LegInTime& leg) {
    constexpr double depth = 1e-9;  // [A0] up to which it is no impact: a grazing curve runs along it
    OrbitFault fault;
    double highest = depth;
    bool has_left = leg.start[0] <= 0;
    double looked_until = leg.from;
    const double margin = margin_of(leg);
    const auto velocity = [](double, const State<double>& x) { return x[1]; };
    const auto leaves_before = [&](double until) {
        for (double time = looked_until; !has_left && time < until;) {
            time = std::min(next_look(leg, time), until);
            has_left = leg.at(time)[0] < 0;
        }
        looked_until = until;
        return has_left;
    };
    each_maximum(leg, velocity, [&](double time, const State<double>& x) {
        if (!leaves_before(time) || x[0] <= highest || leg.to - time < margin || time - leg.from < margin)
            return;
        highest = x[0];
        fault = {OrbitFault::Kind::pierces, leg.event, time};
    });
    if (fault.kind != OrbitFault::Kind::none) return fault;
    // events too brief for the sampling
    const auto met = first_in(leg);
    if (!met) return fault;
    if (met->kind == EventKind::resume) return {OrbitFault::Kind::pattern, leg.event, met->time};
    const double top = top_after(leg, *met);
    if (leg.at(top)[0] > depth) fault = {OrbitFault::Kind::pierces, leg.event, top};
    return fault;
}

OrbitFault fault_of_contact(const LegInTime& leg) {
    const auto met = first_in(leg);
    return met ? OrbitFault{OrbitFault::Kind::pattern, leg.event, met->time} : OrbitFault{};
}

bool has_lost_its_speed(const Event& event) {
    if (event.kind == EventKind::touch) return event.velocity <= 0;
    if (event.kind == EventKind::resume) return event.velocity >= 0;
    return false;
}

}  // namespace

OrbitFault find_fault(const Rig& rigs, const OrbitPoint& point) {
    const PlacedRig rig = rigs.at(point.place);
    OrbitFault pattern;
    const std::size_t count = point.orbit.events.size();
    for (std::size_t i = 0; i < count; ++i) {
        if (has_lost_its_speed(point.orbit.events[i]))
            return {OrbitFault::Kind::slow, i, point.orbit.events[i].time};
    }
    for (std::size_t i = 0; i < count; ++i) {
        const LegInTime leg = leg_in_time(rig, point, i);
        if (!(leg.to > leg.from)) {
            pattern = {OrbitFault::Kind::pattern, i, leg.from};
            continue;
        }
        const OrbitFault fault = leg.presses() ? fault_of_contact(leg) : fault_of_flight(leg);
        if (fault.kind == OrbitFault::Kind::pierces) return fault;
        if (fault.kind == OrbitFault::Kind::pattern) pattern = fault;
    }
    return pattern;
}

double peak_force(const Rig& rigs, const OrbitPoint& point) {
    if (rigs.is_rigid()) return std::numeric_limits<double>::quiet_NaN();
    const PlacedRig rig = rigs.at(point.place);
    double largest = 0;
    for (std::size_t i = 0; i < point.orbit.events.size(); ++i) {
        const LegInTime leg = leg_in_time(rig, point, i);
        if (!leg.presses()) continue;
        largest = std::max(largest, rig.force(leg.start));
        const auto slope = [&](double time, const State<double>& x) { return leg.force(time, x)[1]; };
        each_maximum(leg, slope,
                     [&](double, const State<double>& x) { largest = std::max(largest, rig.force(x)); });
    }
    return largest;
}

}  // namespace peterka::curves
