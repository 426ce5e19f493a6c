// The equation of motion as a right-hand side with its derivatives, as general-purpose integrators need it.
//
//     delta'' = eta^2 sin(theta) - 2 zeta delta' - u - r - f,    u = delta + gap, theta = eta tau,
//     f(delta, delta') while the stop presses, 0 otherwise: see trajectory/contact_force.hpp,
//     r = cubic u^3 (relative), or cubic (x^3 - y^3) with y = sin(theta), x = u + y (absolute).
// Eqs. 3-6 and 14-17 of Aguiar & Weber, nondimensional: see scene/oscillator.hpp. All numbers are in units of
// A0 and A0 omega; a jerk is in A0 omega^3.
#pragma once

#include <cmath>

#include "scene/oscillator.hpp"
#include "trajectory/cycle.hpp"

namespace peterka::trajectory {

template <class Real>
struct Acceleration {
    Real value;
    Real by_position;
    Real by_velocity;
    Real by_time;            // at fixed position and velocity
    Real by_position_twice;  // second derivatives; the one by velocity is 0
    Real by_both;            // by position and velocity

    // Its derivative along the trajectory with this velocity.
    [[nodiscard]] Real jerk(Real velocity) const {
        return by_time + by_position * velocity + by_velocity * value;
    }
};

// At the state x = (delta, delta') and the forcing phase theta.
template <class Real>
Acceleration<Real> acceleration(const Oscillator<Real>& oscillator, Phase phase, const State<Real>& x,
                                Real theta) {
    const Real sine = std::sin(theta);
    const Real cosine = std::cos(theta);
    const Real u = x[0] + oscillator.gap;
    Acceleration<Real> a{.value = oscillator.drive() * sine - 2 * oscillator.damping_ratio * x[1] - u,
                         .by_position = -1,
                         .by_velocity = -2 * oscillator.damping_ratio,
                         .by_time = oscillator.drive() * oscillator.frequency * cosine,
                         .by_position_twice = 0,
                         .by_both = 0};
    if (oscillator.cubic != 0) {
        const bool absolute = oscillator.cubic_form == job::CubicForm::absolute;
        const Real cart = absolute ? sine : Real(0);  // the relative form is the absolute one of a cart at rest
        const Real cart_velocity = absolute ? oscillator.frequency * cosine : Real(0);
        const Real hammer = u + cart;
        // u (x^2 + x y + y^2) is x^3 - y^3 without its cancellation
        a.value -= oscillator.cubic * u * (hammer * hammer + hammer * cart + cart * cart);
        a.by_position -= 3 * oscillator.cubic * hammer * hammer;
        a.by_position_twice = -6 * oscillator.cubic * hammer;
        a.by_time -= 3 * oscillator.cubic * u * (hammer + cart) * cart_velocity;
    }
    if (phase == Phase::contact) {
        const ContactResponse<Real> f = contact_response(oscillator, x);
        a.value -= f.force;
        a.by_position -= f.by_position;
        a.by_velocity -= f.by_velocity;
        a.by_position_twice -= f.by_position_twice;
        a.by_both -= f.by_both;
    }
    return a;
}

}  // namespace peterka::trajectory
