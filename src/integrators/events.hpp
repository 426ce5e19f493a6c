// What happens within an integrator's last step: its first event, and the largest force and displacement.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

#include "integrators/leg.hpp"
#include "integrators/search.hpp"
#include "support/stop_request.hpp"
#include "trajectory/contact_rates.hpp"
#include "trajectory/first_crossing.hpp"

namespace peterka::integrators {

using trajectory::contact_response;
using trajectory::grip;
using trajectory::lets_go_at_surface;
using trajectory::lets_go_inside;
using trajectory::linearized_contact;
using trajectory::parabola_step;

// Taylor expansion over a step so short that the remainder is below rounding.
inline LegPoint extrapolated(const SundialsLeg& leg, const LegPoint& point, double step) {
    const auto a = leg.acceleration_at(point.state, point.time);
    const double velocity = point.state[1];
    const double jerk = a.jerk(velocity);
    LegPoint end = point;
    end.time += step;
    end.state[0] += step * (velocity + step * (a.value / 2 + step * jerk / 6));
    end.state[1] += step * (a.value + step * jerk / 2);
    Jacobian<double> rate;
    rate << 0, 1, a.by_position, a.by_velocity;
    const Jacobian<double> once = step * rate * point.flow;
    end.flow += once + step / 2 * rate * once;
    return end;
}

// Leg and stepper must outlive this object.
template <class Stepper>
class StepEvents {
  public:
    StepEvents(const SundialsLeg& leg, Stepper& stepper) : leg_(&leg), stepper_(&stepper) {}

    struct Event {
        Phase next = Phase::flight;
        LegPoint point{};
    };
    [[nodiscard]] std::optional<Event> first_event();
    // No event is possible up to this time of the leg, whatever rounding suggests.
    void trust_after(double time) { quiet_ = time; }

    // Over the step up to `end`; never less than `largest`.
    [[nodiscard]] double largest_force(const LegPoint& end, double largest);
    [[nodiscard]] double displacement_bound(const LegPoint& end, double largest) const;
    [[nodiscard]] double largest_displacement(const LegPoint& end, double largest);

    // Over the step up to `end`, of the forces on the hammer other than the stop's.
    struct Integrals {
        double push = 0;         // of its acceleration a without the stop
        double push_work = 0;    // of a delta'
        double drive_work = 0;   // of eta^2 sin(theta) delta'
        double damper_work = 0;  // of 2 zeta delta'^2
    };
    void add_integrals(const LegPoint& end, Integrals& sum);

    // At a time of the leg within the last step.
    [[nodiscard]] State<double> state_at(double time) { return look(time).state; }

    // An integration to a point within the step failed: the results are void.
    [[nodiscard]] bool failed() const { return failed_; }
    void forget_failure() { failed_ = false; }

  private:
    enum class Signal { touch, leave, release, resume };  // each rises through zero at its event
    struct Watch {
        Signal signal;
        Phase next;
    };
    // What can end the present phase.
    [[nodiscard]] std::span<const Watch> watched() const;

    [[nodiscard]] std::optional<LegPoint> locate(Signal signal, const LegPoint& end);
    [[nodiscard]] LegPoint refine(Signal signal, Bracket bracket);
    [[nodiscard]] Sample force(const LegPoint& point) const;
    [[nodiscard]] Sample hold(const LegPoint& point) const;
    [[nodiscard]] Sample sample(Signal signal, const LegPoint& point) const;
    [[nodiscard]] LegPoint look(double time) {
        stop_if_asked();
        LegPoint point = stepper_->before();
        if (!stepper_->look(time, point)) failed_ = true;
        return point;
    }

    // Whether the step passes over the fast decay of a contact: the motion then follows the balance of forces.
    [[nodiscard]] bool passes_over_transients() const {
        return leg_->phase == Phase::contact &&
               (stepper_->now().time - stepper_->before().time) * fastest(stepper_->before().state) > 3;
    }
    [[nodiscard]] double fastest(const State<double>& x) const {
        return rates_of(linearized_contact(leg_->oscillator, x)).fast;
    }
    // Slope of the force where it balances all others except inertia, which is small; computed from the state
    // it would be noise.
    [[nodiscard]] double balanced_slope(const LegPoint& point) const {
        const double angle = leg_->start_angle + leg_->oscillator.frequency * point.time;
        const auto free = acceleration(leg_->oscillator, Phase::flight, point.state, angle);
        return free.by_time + free.by_position * point.state[1];
    }
    // Error of the grip at such a point, where its terms cancel.
    [[nodiscard]] double noise(const State<double>& x) const {
        const auto g = grip(leg_->oscillator, x);
        return leg_->local_tolerance * (std::abs(g.by_position * x[0]) + std::abs(g.by_velocity * x[1])) / 2;
    }
    static constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

    const SundialsLeg* leg_;
    Stepper* stepper_;
    bool failed_ = false;
    double quiet_ = 0;
};

// The force that the stop exerts or would exert at this point of the present phase, and its derivatives.
template <class Stepper>
Sample StepEvents<Stepper>::force(const LegPoint& point) const {
    const State<double>& x = point.state;
    const auto f = contact_response(leg_->oscillator, x);
    if (passes_over_transients()) return {point.time, f.force, balanced_slope(point), not_known};
    const auto a = leg_->acceleration_at(x, point.time);
    return {point.time, f.force, f.by_position * x[1] + f.by_velocity * a.value,
            (f.by_position_twice * x[1] + 2 * f.by_both * a.value) * x[1] + f.by_position * a.value +
                f.by_velocity * a.jerk(x[1])};
}

// Positive while the stop presses, at delta > 0.
template <class Stepper>
Sample StepEvents<Stepper>::hold(const LegPoint& point) const {
    const State<double>& x = point.state;
    const auto g = grip(leg_->oscillator, x);
    if (passes_over_transients() && g.force_per_value > 0) {
        const double slope = balanced_slope(point) / g.force_per_value - g.value * g.growth * x[1];
        return {point.time, g.value, slope, not_known};
    }
    const auto a = leg_->acceleration_at(x, point.time);
    return {point.time, g.value, g.by_position * x[1] + g.by_velocity * a.value,
            g.by_position * a.value + g.by_velocity * a.jerk(x[1])};
}

template <class Stepper>
Sample StepEvents<Stepper>::sample(Signal signal, const LegPoint& point) const {
    Sample s{};
    if (signal == Signal::touch || signal == Signal::leave) {
        s = {point.time, point.state[0], point.state[1], leg_->acceleration_at(point.state, point.time).value};
    } else {
        s = hold(point);
    }
    if (signal == Signal::leave || signal == Signal::release) s = {s.time, -s.value, -s.slope, -s.curvature};
    return s;
}

template <class Stepper>
auto StepEvents<Stepper>::watched() const -> std::span<const Watch> {
    static constexpr std::array in_flight{Watch{Signal::touch, Phase::contact}};
    static constexpr std::array in_contact{Watch{Signal::release, Phase::unloaded},
                                           Watch{Signal::leave, Phase::flight}};
    static constexpr std::array while_unloaded{Watch{Signal::leave, Phase::flight},
                                               Watch{Signal::resume, Phase::contact}};
    if (leg_->phase == Phase::flight) return in_flight;
    if (leg_->phase == Phase::unloaded) return while_unloaded;
    const std::span<const Watch> both = in_contact;
    if (!lets_go_inside(leg_->oscillator)) return both.last(1);
    return lets_go_at_surface(leg_->oscillator) ? both : both.first(1);
}

// Newton's method with curvature inside a bracket. The last correction is a Taylor step, so that not only the
// time of the event but also the point is as accurate as the integration.
template <class Stepper>
LegPoint StepEvents<Stepper>::refine(Signal signal, Bracket bracket) {
    constexpr int most_corrections = 50;
    // The longest Taylor step, in units of the fastest time. Its error is of fourth order, that is, at rounding
    // level. Where the law's force grows as a fractional power of delta from delta = 0, the order is lower
    // (2.5 in the velocity for a power of 1.5), so the step has to be shorter.
    const bool smooth = scene::has_smooth_force(leg_->oscillator.contact);
    const double short_step = smooth ? 1e-4 : 1e-7;
    auto& [below, above] = bracket;
    const SignalCurve curve(below, above);
    const double share = sign_change([&](double s) { return curve.value(s); }, true);
    double time = below.time + share * (above.time - below.time);
    double rate = std::max(1.0, leg_->oscillator.frequency);
    if (leg_->phase == Phase::contact) rate = std::max(rate, fastest(stepper_->before().state));
    LegPoint point;
    for (int n = 0; n < most_corrections; ++n) {
        point = look(time);
        const Sample s = sample(signal, point);
        (s.value > 0 ? above : below) = s;
        const bool rough = std::isnan(s.curvature);
        const double correction = rough ? -s.value / s.slope : parabola_step(s.value, s.slope, s.curvature);
        if (!rough && std::abs(correction) * rate < short_step) return extrapolated(*leg_, point, correction);
        if (above.time - below.time <= 4 * std::numeric_limits<double>::epsilon() * above.time) break;
        if (rough && std::abs(s.value) <= noise(point.state) / 10) break;
        time += correction;
        if (!(time > below.time && time < above.time)) time = (below.time + above.time) / 2;
    }
    return point;
}

// The event of this signal in the last step, up to `end`.
template <class Stepper>
std::optional<LegPoint> StepEvents<Stepper>::locate(Signal signal, const LegPoint& end) {
    if (end.time <= quiet_) return std::nullopt;
    const LegPoint& before = stepper_->before();
    Sample start = sample(signal, before.time < quiet_ ? look(quiet_) : before);
    start.value = std::min(start.value, 0.0);  // a leg starts on a surface, up to rounding
    int looks = most_looks;
    const auto bracket = first_rise(
        start, sample(signal, end), [&](double time) { return sample(signal, look(time)); }, looks);
    if (!bracket && looks <= 0) failed_ = true;
    if (!bracket) return std::nullopt;
    return refine(signal, *bracket);
}

template <class Stepper>
auto StepEvents<Stepper>::first_event() -> std::optional<Event> {
    const LegPoint end = stepper_->now();
    std::optional<Event> first;
    for (const Watch& watch : watched()) {
        const auto point = locate(watch.signal, end);
        if (point && (!first || point->time < first->point.time)) first = Event{watch.next, *point};
    }
    return first;
}

template <class Stepper>
double StepEvents<Stepper>::largest_force(const LegPoint& end, double largest) {
    const LegPoint& start = stepper_->before();
    if (!(end.time > start.time)) return std::max(largest, force(end).value);
    const auto between = [&](double time) { return force(look(time)); };
    int looks = most_looks;
    return largest_between(force(start), force(end), between, leg_->local_tolerance, largest, looks);
}

template <class Stepper>
double StepEvents<Stepper>::displacement_bound(const LegPoint& end, double largest) const {
    const LegPoint& start = stepper_->before();
    const double gap = leg_->oscillator.gap;
    largest = std::max({largest, std::abs(start.state[0] + gap), std::abs(end.state[0] + gap)});
    if (!(end.time > start.time) || passes_over_transients()) return largest;
    const SignalCurve position(sample(Signal::touch, start), sample(Signal::touch, end));
    for (const double bound : position.at) largest = std::max(largest, std::abs(bound + gap));
    return largest;
}

template <class Stepper>
double StepEvents<Stepper>::largest_displacement(const LegPoint& end, double largest) {
    const LegPoint& start = stepper_->before();
    for (const double side : {1.0, -1.0}) {
        const auto outwards = [&](const LegPoint& point) {
            const double a =
                passes_over_transients() ? not_known : leg_->acceleration_at(point.state, point.time).value;
            return Sample{point.time, side * (point.state[0] + leg_->oscillator.gap), side * point.state[1],
                          side * a};
        };
        if (end.time > start.time) {
            int looks = most_looks;
            largest = largest_between(
                outwards(start), outwards(end), [&](double time) { return outwards(look(time)); },
                leg_->local_tolerance, largest, looks);
        } else {
            largest = std::max(largest, outwards(end).value);
        }
    }
    return largest;
}

// Gauss-Legendre quadrature with 4 nodes: within a step the motion turns by about a radian.
template <class Stepper>
void StepEvents<Stepper>::add_integrals(const LegPoint& end, Integrals& sum) {
    constexpr std::array nodes{-0.8611363115940526, -0.3399810435848563, 0.3399810435848563,
                               0.8611363115940526};
    constexpr std::array weights{0.3478548451374538, 0.6521451548625461, 0.6521451548625461,
                                 0.3478548451374538};
    const auto& oscillator = leg_->oscillator;
    const double start = stepper_->before().time;
    const double half = (end.time - start) / 2;
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const LegPoint point = look(start + half * (1 + nodes[i]));
        const double angle = leg_->start_angle + oscillator.frequency * point.time;
        const double velocity = point.state[1];
        const double push = acceleration(oscillator, Phase::flight, point.state, angle).value;
        const double weight = half * weights[i];
        sum.push += weight * push;
        sum.push_work += weight * push * velocity;
        sum.drive_work += weight * oscillator.drive() * std::sin(angle) * velocity;
        sum.damper_work += weight * 2 * oscillator.damping_ratio * velocity * velocity;
    }
}

}  // namespace peterka::integrators
