#include "study/rk4_cycle_map.hpp"

#include "support/stop_request.hpp"

namespace peterka::study {

using trajectory::acceleration;
using trajectory::contact_force;

Rk4CycleMap::Block Rk4CycleMap::rate(Phase phase, const Block& z, double time) const {
    const auto a = acceleration(oscillator_, phase, State<double>(z.col(0)), oscillator_.frequency * time);
    Block rate;
    rate(0, 0) = z(1, 0);
    rate(1, 0) = a.value;
    rate.block<1, 2>(0, 1) = z.block<1, 2>(1, 1);
    rate.block<1, 2>(1, 1) = a.by_position * z.block<1, 2>(0, 1) + a.by_velocity * z.block<1, 2>(1, 1);
    return rate;
}

Rk4CycleMap::Block Rk4CycleMap::step(Phase phase, const Block& z, double time, double h) const {
    const auto rate_at = [&](const Block& stage, double t) { return rate(phase_at(phase, stage), stage, t); };
    const Block k1 = rate_at(z, time);
    const Block k2 = rate_at(z + h / 2 * k1, time + h / 2);
    const Block k3 = rate_at(z + h / 2 * k2, time + h / 2);
    const Block k4 = rate_at(z + h * k3, time + h);
    return z + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
}

double Rk4CycleMap::over(Phase phase, const Block& z) const {
    const double force = contact_force(oscillator_, State<double>(z.col(0)));
    switch (phase) {
        case Phase::flight:
            return z(0, 0);
        case Phase::contact:
            return -force;
        case Phase::unloaded:
            break;
    }
    return std::max(-z(0, 0), force);
}

// Length of the step that ends together with the phase, by bisection.
double Rk4CycleMap::event_in_step(Phase phase, const Block& z, double time, double h) const {
    constexpr int halvings = 60;
    double before = 0;
    double after = h;
    for (int n = 0; n < halvings; ++n) {
        const double middle = (before + after) / 2;
        if (middle == before || middle == after) break;
        (over(phase, step(phase, z, time, middle)) > 0 ? after : before) = middle;
    }
    return after;
}

Phase Rk4CycleMap::enter_next(Phase phase, Block& z, double time, MeasuredCycle<double>& cycle) const {
    if (phase == Phase::flight) {
        ++cycle.impacts;
        cycle.last_touch = time;
        cycle.impact_speed = std::max(cycle.impact_speed, z(1, 0));
        z(0, 0) = 0;
        z.block<1, 2>(1, 1) -= oscillator_.kelvin_voigt().damping * z.block<1, 2>(0, 1);
        return Phase::contact;
    }
    const bool elastic = phase == Phase::contact && oscillator_.kelvin_voigt().damping == 0;
    if (elastic || !(z(0, 0) > 0)) {
        z(0, 0) = 0;
        return Phase::flight;
    }
    return phase == Phase::contact ? Phase::unloaded : Phase::contact;
}

Rk4CycleMap::Sample Rk4CycleMap::sample(const Block& z, double time) const {
    const State<double> x = z.col(0);
    const auto a = acceleration(oscillator_, Phase::contact, x, oscillator_.frequency * time);
    const auto& law = oscillator_.kelvin_voigt();
    return {contact_force(oscillator_, x), law.stiffness * x[1] + law.damping * a.value};
}

// Largest force over a step in contact, including the interior maximum of the cubic Hermite interpolant, if
// any.
void Rk4CycleMap::measure_step(Phase phase, const Block& from, double time, const Block& to, double h,
                               MeasuredCycle<double>& cycle) const {
    cycle.largest_displacement = std::max(cycle.largest_displacement, std::abs(to(0, 0) + oscillator_.gap));
    if (phase_at(phase, to) != Phase::contact && phase_at(phase, from) != Phase::contact) return;
    const Sample a = sample(from, time);
    const Sample b = sample(to, time + h);
    if (phase_at(phase, from) == Phase::contact) cycle.peak_force = std::max(cycle.peak_force, a.force);
    if (phase_at(phase, to) == Phase::contact) cycle.peak_force = std::max(cycle.peak_force, b.force);
    if (events_ == Rk4Events::ignored || !(a.slope > 0 && b.slope < 0)) return;
    // slope of the cubic at s = t/h: c0 + c1 s + c2 s^2
    const double c0 = h * a.slope;
    const double rise = b.force - a.force;
    const double c1 = 6 * rise - 4 * h * a.slope - 2 * h * b.slope;
    const double c2 = 3 * (h * a.slope + h * b.slope - 2 * rise);
    const double root = std::sqrt(std::max(c1 * c1 - 4 * c2 * c0, 0.0));
    const double s = 2 * c0 / (root - c1);
    if (!(s > 0 && s < 1)) return;
    cycle.peak_force = std::max(cycle.peak_force, a.force + s * (c0 + s * (c1 / 2 + s * c2 / 3)));
}

MeasuredCycle<double> Rk4CycleMap::operator()(const State<double>& x, bool measure) const {
    using Outcome = typename Cycle<double>::Outcome;
    constexpr int most_events = 20'000;
    MeasuredCycle<double> cycle;
    Block z;
    z << x, Jacobian<double>::Identity();
    Phase phase = phase_of(oscillator_, x);
    const double period = oscillator_.period();
    double time = 0;
    int events = 0;
    for (int n = 0; n < steps_; ++n) {
        stop_if_asked();
        const double end = n + 1 < steps_ ? period * (n + 1) / steps_ : period;
        while (time < end) {
            double h = end - time;
            const Block from = z;
            z = step(phase, from, time, h);
            const bool event = events_ == Rk4Events::located && over(phase, z) > 0;
            if (event) {
                h = event_in_step(phase, from, time, h);
                z = step(phase, from, time, h);
            }
            if (!z.allFinite()) {
                cycle.outcome = Outcome::not_finite;
                return cycle;
            }
            cycle.touched |= phase == Phase::contact;
            cycle.separated |= phase == Phase::flight;
            if (measure) measure_step(phase, from, time, z, h, cycle);
            time = event ? time + h : end;
            if (event) {
                if (++events > most_events) {
                    cycle.outcome = Outcome::too_many_events;
                    return cycle;
                }
                phase = enter_next(phase, z, time, cycle);
            } else if (events_ == Rk4Events::ignored) {
                const Phase now = phase_of(oscillator_, State<double>(z.col(0)));
                if (phase == Phase::flight && now != Phase::flight) {
                    ++cycle.impacts;
                    cycle.last_touch = time;
                    cycle.impact_speed = std::max(cycle.impact_speed, z(1, 0));
                }
                phase = now;
            }
        }
    }
    cycle.end = z.col(0);
    cycle.jacobian = z.rightCols<2>();
    return cycle;
}

}  // namespace peterka::study
