// Bounds of the derivatives along a leg near a known moment, as the better of two: one from the length of the
// whole motion, which holds also at a resonance, whose steady response is far larger (reach.hpp); the other
// from the length of the decaying part, which only the cubic term drives, plus the steady response, whose
// derivatives are |R| eta^n: sharp where the hammer is pressed against a stiff stop for long.
#pragma once

#include "certificate/leg.hpp"

namespace peterka::certificate {

struct Bends {
    double velocity;  // bounds of |delta'|, |delta''|, ...
    double acceleration;
    double jerk;
    double snap;

    // For the force kappa delta + chi delta'.
    template <class Number>
    [[nodiscard]] double of_force(const RigOf<Number>& rig) const {  // bound of its second derivative
        return size_of(rig.stiffness) * acceleration + size_of(rig.damping) * jerk;
    }
    template <class Number>
    [[nodiscard]] double of_slope(const RigOf<Number>& rig) const {  // bound of its third derivative
        return size_of(rig.stiffness) * jerk + size_of(rig.damping) * snap;
    }
};

// A time over which the bounds are good; in both directions they require c h <= 1.
template <class Number>
double short_time(const Phase<Number>& phase) {
    return 1 / (std::sqrt(size_of(phase.stiffness())) + size_of(phase.damping()) + size_of(phase.frequency()));
}

// Bounds from the length r.
template <class Number>
Bends bends_by_length(const Phase<Number>& phase, double r, const Drive& drive) {
    const double c = size_of(phase.damping());
    const double k = size_of(phase.stiffness());
    Bends bend{};
    bend.velocity = r;
    bend.acceleration = drive.value + (c + std::sqrt(k)) * r;
    bend.jerk = drive.rate + c * bend.acceleration + k * r;
    bend.snap = drive.bend + c * bend.jerk + k * bend.acceleration;
    return bend;
}

// Bounds over a time h from this moment on, or around it. Only a few sums and products of positive numbers are
// rounded: far less than the margin added at the end.
template <class Number>
Bends bends(const Phase<Number>& phase, const Moment<Number>& moment, double h, Within within) {
    const double ch = size_of(phase.damping()) * h;
    const double eta = size_of(phase.frequency());
    const double growth = within == Within::both_ways ? 1 + ch + ch * ch : 1;  // exp(x) up to x = 1
    const Reach reach = reach_of(phase, moment.state, h, within);
    const Drive& cubic = reach.cubic;
    const Drive all{eta * eta + cubic.value, eta * eta * eta + cubic.rate, eta * eta * eta * eta + cubic.bend};
    const Bends whole = bends_by_length(phase, reach.velocity, all);
    const double decaying = (length_of(phase, moment.decaying) + cubic.value * h) * growth;
    const Bends part = bends_by_length(phase, decaying, cubic);
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
