// The nondimensional oscillator: one hammer, one stop, one harmonic cart.
//
// tau = omega t, u = (x - y)/A0, velocities in A0 omega, forces in k A0, with omega = sqrt(k/m):
//     u'' + 2 zeta u' + u + r = eta^2 sin(eta tau) - f,
// with the penetration delta = u - gap and the force f(delta, delta') of the stop, see scene/contact_law.hpp
// (eqs. 3-6 and 14-17 of Aguiar & Weber). The cubic part of the springs is r = cubic u^3 (relative, eq. 14) or
// r = cubic (x^3 - y^3) with y = sin(eta tau) and x = u + y (absolute, eq. 3).
// The state used everywhere is (delta, delta'), relative to the stop, so that nothing cancels at a stiff stop.
#pragma once

#include <Eigen/Core>
#include <numbers>

#include "job/job.hpp"
#include "scene/contact_law.hpp"

namespace peterka::scene {

template <class Real>
using State = Eigen::Matrix<Real, 2, 1>;  // (delta, delta') in A0 and A0 omega

template <class Real>
using Jacobian = Eigen::Matrix<Real, 2, 2>;

template <class Real>
struct Oscillator {
    Real damping_ratio = 0;  // zeta = c/(2 m omega)
    ContactLaw<Real> contact = {};
    Real frequency = 0;  // eta = Omega/omega; 0: the cart is at rest
    Real gap = 0;        // gap/A0
    Real cubic = 0;      // k3 A0^2/k
    job::CubicForm cubic_form = job::CubicForm::relative;

    // Amplitude of the forcing, and its period in tau; with a cart at rest the hammer's own period.
    [[nodiscard]] Real drive() const { return frequency * frequency; }
    [[nodiscard]] Real period() const {
        return 2 * std::numbers::pi_v<Real> / (frequency > 0 ? frequency : Real(1));
    }

    // The cart's amplitude, which the absolute form of the cubic adds to the hammer's reach.
    [[nodiscard]] Real cart_reach() const { return frequency > 0 ? 1 : 0; }

    // The stop if it is a spring and dashpot, else null; for code specific to that law.
    [[nodiscard]] const KelvinVoigt<Real>* spring_dashpot() const {
        return std::get_if<KelvinVoigt<Real>>(&contact);
    }
    // The spring-dashpot stop and the rigid one, for code specific to that law; std::bad_variant_access for any
    // other law.
    [[nodiscard]] const KelvinVoigt<Real>& kelvin_voigt() const { return std::get<KelvinVoigt<Real>>(contact); }
    [[nodiscard]] const Restitution<Real>& restitution() const { return std::get<Restitution<Real>>(contact); }
    [[nodiscard]] KelvinVoigt<Real>& kelvin_voigt() { return std::get<KelvinVoigt<Real>>(contact); }
};

// Whether nothing takes energy from the hammer.
template <class Real>
[[nodiscard]] bool is_conservative(const Oscillator<Real>& oscillator) {
    return oscillator.damping_ratio == 0 && is_lossless(oscillator.contact);
}

// The same hammer with linear springs.
template <class Real>
[[nodiscard]] Oscillator<Real> without_cubic(Oscillator<Real> oscillator) {
    oscillator.cubic = 0;
    return oscillator;
}

}  // namespace peterka::scene
