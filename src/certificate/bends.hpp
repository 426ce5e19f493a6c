// How fast a leg can bend near a moment that is known, in two ways, of which the better counts.
//
// With y = delta + g/K, the length r = sqrt(delta'^2 + K y^2) grows by at most eta^2 in a unit of time, for
// r r' = delta' (eta^2 sin(theta) - c delta'); backwards it grows to (r + eta^2 h) exp(c h) at most in a time
// h. |delta'| and sqrt(K) |y| stay below r, and the equation bounds the higher derivatives by it. So the bounds
// follow the motion as it is, also at a resonance, whose steady response is far larger.
//
// What decays has no forcing, so that its r never grows, and the steady response bends by |R| eta^n: narrow
// where the hammer is pressed against a stiff stop for long.
#pragma once

#include <algorithm>
#include <cmath>

#include "certificate/phase.hpp"

namespace peterka::certificate {

struct Bends {
    double velocity;  // bounds of |delta'|, |delta''|, ...
    double acceleration;
    double jerk;
    double snap;

    // Of the force kappa delta + chi delta'.
    template <class Number>
    [[nodiscard]] double of_force(const RigOf<Number>& rig) const {  // its second derivative
        return size_of(rig.stiffness) * acceleration + size_of(rig.damping) * jerk;
    }
    template <class Number>
    [[nodiscard]] double of_slope(const RigOf<Number>& rig) const {  // its third
        return size_of(rig.stiffness) * jerk + size_of(rig.damping) * snap;
    }
};

enum class Within { later, both_ways };

// A time in which they are good bounds; both ways they need c h <= 1.
template <class Number>
double short_time(const Phase<Number>& phase) {
    return 1 / (std::sqrt(size_of(phase.stiffness())) + size_of(phase.damping()) + size_of(phase.frequency()));
}

template <class Number>
double length_of(const Phase<Number>& phase, const Vector<Number>& rest) {
    const double v = size_of(rest.velocity);
    const double y = size_of(rest.position);
    return std::sqrt(v * v + size_of(phase.stiffness()) * y * y);
}

// From the length r on, with a drive of which each derivative is eta times the one before.
template <class Number>
Bends bends_by_length(const Phase<Number>& phase, double r, double drive) {
    const double c = size_of(phase.damping());
    const double k = size_of(phase.stiffness());
    const double eta = size_of(phase.frequency());
    Bends bend{};
    bend.velocity = r;
    bend.acceleration = drive + (c + std::sqrt(k)) * r;
    bend.jerk = drive * eta + c * bend.acceleration + k * r;
    bend.snap = drive * eta * eta + c * bend.jerk + k * bend.acceleration;
    return bend;
}

// Of a time h from this moment on, or around it. A few sums and products of positive numbers are rounded: far
// less than what is added in the end.
template <class Number>
Bends bends(const Phase<Number>& phase, const Moment<Number>& moment, double h, Within within) {
    const double ch = size_of(phase.damping()) * h;
    const double eta = size_of(phase.frequency());
    const double drive = eta * eta;
    const double growth = within == Within::both_ways ? 1 + ch + ch * ch : 1;  // exp(x) up to x = 1
    const Vector<Number> from_rest{moment.state.position - phase.rest(), moment.state.velocity};
    const Bends whole = bends_by_length(phase, (length_of(phase, from_rest) + drive * h) * growth, drive);
    const Bends part = bends_by_length(phase, length_of(phase, moment.decaying) * growth, 0);
    const double swing = phase.swing() * eta;
    const auto better = [](double one, double other) {
        constexpr double rounding = 1 + 1e-12;
        return std::min(one, other) * rounding;
    };
    return {better(whole.velocity, part.velocity + swing),
            better(whole.acceleration, part.acceleration + swing * eta),
            better(whole.jerk, part.jerk + swing * eta * eta),
            better(whole.snap, part.snap + swing * eta * eta * eta)};
}

}  // namespace peterka::certificate
