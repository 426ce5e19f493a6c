// The force of a stop as a function of the state, with its derivatives, and where the stop lets go.
//
//     Kelvin-Voigt    f = kappa delta + chi delta'       lets go where f falls through 0
//     Hunt-Crossley   f = K delta^n (1 + D delta')       lets go where 1 + D delta' falls through 0, or at
//     delta = 0
// Both formulas omit the laws' "never pulls": the phases take care of that. A rigid stop acts by impacts and
// has no such force: 0. Units as in scene/contact_law.hpp. Hunt-Crossley's formula is continued to delta < 0 as
// an odd function, so that an integrator may step past the end of a contact before locating it.
#pragma once

#include <cmath>
#include <limits>
#include <variant>

#include "scene/oscillator.hpp"

namespace peterka::trajectory {

// The force and its derivatives by delta and delta'; the second derivative by delta' is 0 in every law.
template <class Real>
struct ContactResponse {
    Real force = 0;
    Real by_position = 0;
    Real by_velocity = 0;
    Real by_position_twice = 0;  // infinite at delta = 0 where a Hunt-Crossley exponent is between 1 and 2
    Real by_both = 0;
};

template <class Real>
ContactResponse<Real> contact_response(const scene::KelvinVoigt<Real>& law, const scene::State<Real>& x) {
    return {.force = law.stiffness * x[0] + law.damping * x[1],
            .by_position = law.stiffness,
            .by_velocity = law.damping};
}

template <class Real>
ContactResponse<Real> contact_response(const scene::Restitution<Real>& /*law*/,
                                       const scene::State<Real>& /*x*/) {
    return {};
}

template <class Real>
ContactResponse<Real> contact_response(const scene::HuntCrossley<Real>& law, const scene::State<Real>& x) {
    const Real n = law.exponent;
    const Real slope = law.stiffness * std::pow(std::abs(x[0]), n - 1);  // K |delta|^(n-1)
    const Real share = 1 + law.dissipation * x[1];
    ContactResponse<Real> f{.force = slope * x[0] * share,
                            .by_position = n * slope * share,
                            .by_velocity = slope * x[0] * law.dissipation,
                            .by_both = n * slope * law.dissipation};
    if (n > 1) {
        const Real bend = x[0] != 0 ? slope / x[0] : law.stiffness * std::pow(Real(0), n - 2);
        f.by_position_twice = n * (n - 1) * bend * share;
    }
    return f;
}

template <class Real>
ContactResponse<Real> contact_response(const scene::Oscillator<Real>& oscillator, const scene::State<Real>& x) {
    return std::visit([&](const auto& law) { return contact_response(law, x); }, oscillator.contact);
}

template <class Real>
Real contact_force(const scene::Oscillator<Real>& oscillator, const scene::State<Real>& x) {
    return contact_response(oscillator, x).force;
}

// The quantity that must be positive for the stop to press at delta > 0, and the factor that turns it into the
// force.
template <class Real>
struct Grip {
    Real value = 0;
    Real by_position = 0;
    Real by_velocity = 0;
    Real force_per_value = 1;
    Real growth = 0;  // relative, of that factor with delta
};

template <class Law, class Real>
Grip<Real> grip(const Law& law, const scene::State<Real>& x) {
    const ContactResponse<Real> f = contact_response(law, x);
    return {.value = f.force, .by_position = f.by_position, .by_velocity = f.by_velocity};
}

template <class Real>
Grip<Real> grip(const scene::HuntCrossley<Real>& law, const scene::State<Real>& x) {
    return {.value = 1 + law.dissipation * x[1],
            .by_velocity = law.dissipation,
            .force_per_value = law.stiffness * std::pow(std::abs(x[0]), law.exponent),
            .growth = law.exponent / x[0]};
}

template <class Real>
Grip<Real> grip(const scene::Oscillator<Real>& oscillator, const scene::State<Real>& x) {
    return std::visit([&](const auto& law) { return grip(law, x); }, oscillator.contact);
}

// Whether the stop can let go while delta > 0, and whether a contact can end at delta = 0.
template <class Real>
bool lets_go_inside(const scene::Oscillator<Real>& oscillator) {
    return !scene::is_rigid(oscillator.contact) && !scene::is_lossless(oscillator.contact);
}
template <class Real>
bool lets_go_at_surface(const scene::Oscillator<Real>& oscillator) {
    return std::visit([](const auto& law) { return law.lets_go_at_surface(); }, oscillator.contact);
}

// The state near x at which the stop just lets go, or presses again.
template <class Real>
scene::State<Real> at_release(const scene::Oscillator<Real>& oscillator, scene::State<Real> x) {
    std::visit([&](const auto& law) { law.move_to_release(x[0], x[1]); }, oscillator.contact);
    return x;
}

}  // namespace peterka::trajectory
