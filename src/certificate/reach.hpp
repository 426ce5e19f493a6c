// How far a motion can move within a time from a known state.
//
// With y = delta + g/K, the length r = sqrt(delta'^2 + K y^2) grows by at most the drive d = eta^2 + |cubic
// term| per unit time, since r r' = delta' (eta^2 sin(theta) - cubic - c delta'); backwards it grows to at most
// (r + d h) exp(c h) in a time h. |delta'| and sqrt(K) |y| stay below r. The cubic term is bounded by |u|, and
// |u| in turn by |delta'|: a bound U with |u(0)| + r(U) h <= U cannot be exceeded within h.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "certificate/phase.hpp"

namespace peterka::certificate {

enum class Within { later, both_ways };

// Bounds of a force and of its first two derivatives.
struct Drive {
    double value = 0;
    double rate = 0;
    double bend = 0;
};

struct Reach {
    double displacement = 0;  // |u|
    double velocity = 0;
    double acceleration = 0;
    Drive cubic;
};

template <class Number>
double length_of(const Phase<Number>& phase, const Vector<Number>& rest) {
    const double v = size_of(rest.velocity);
    const double y = size_of(rest.position);
    return std::sqrt(v * v + size_of(phase.stiffness()) * y * y);
}

// The cubic term's bounds while u, u' and u'' stay below these.
template <class Number>
Drive cubic_drive(const Phase<Number>& phase, double u, double v, double a) {
    const double gamma = size_of(phase.cubic());
    if (!phase.absolute())
        return {phase.largest_cubic(u), gamma * 3 * u * u * v, gamma * 3 * (2 * u * v * v + u * u * a)};
    const double eta = size_of(phase.frequency());
    const double x = u + 1;
    const double rate = v + eta;
    return {phase.largest_cubic(u), gamma * (3 * x * x * rate + 3 * eta),
            gamma * (6 * x * rate * rate + 3 * x * x * (a + eta * eta) + 9 * eta * eta)};
}

// Only a few sums and products of positive numbers are rounded: far less than the margin added at the end.
template <class Number>
Reach reach_of(const Phase<Number>& phase, const Vector<Number>& state, double h,
               Within within = Within::later) {
    constexpr double rounding = 1 + 1e-12;
    const double c = size_of(phase.damping());
    const double eta = size_of(phase.frequency());
    const double growth = within == Within::both_ways ? 1 + c * h + c * h * c * h : 1;  // exp(x) up to x = 1
    const double length = length_of(phase, Vector<Number>{state.position - phase.rest(), state.velocity});
    const double u = size_of(state.position + phase.gap());
    Reach reach;
    reach.displacement = u + 2 * (length + eta * eta * h) * growth * h;
    // The second estimate is for a strong cubic term; where it fails, the term outgrows all further ones, too.
    for (int tries = 0; tries < 2; ++tries) {
        const double drive = eta * eta + phase.largest_cubic(reach.displacement);
        reach.velocity = (length + drive * h) * growth * rounding;
        if ((u + reach.velocity * h) * rounding <= reach.displacement) {
            reach.acceleration =
                (drive + (c + std::sqrt(size_of(phase.stiffness()))) * reach.velocity) * rounding;
            reach.cubic = cubic_drive(phase, reach.displacement, reach.velocity, reach.acceleration);
            return reach;
        }
        reach.displacement = u + 4 * reach.velocity * h;
    }
    const double infinite = std::numeric_limits<double>::infinity();
    return {infinite, infinite, infinite, {infinite, infinite, infinite}};
}

}  // namespace peterka::certificate
