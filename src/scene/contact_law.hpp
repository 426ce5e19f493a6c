// What the stop does to the hammer that touches it: one small struct for each law, nondimensional.
//
// delta is the penetration in A0, delta' its rate in A0 omega, f the force on the hammer in k A0. The stop
// never pulls: f is 0 where a formula gives less, and everywhere for delta <= 0.
#pragma once

#include <variant>

namespace peterka::scene {

// Spring and dashpot: f = kappa delta + chi delta' (eqs. 5-12 of Aguiar & Weber).
template <class Real>
struct KelvinVoigt {
    Real stiffness = 0;  // kappa = ki/k
    Real damping = 0;    // chi = ci/(m omega)
};

// A rigid stop: delta <= 0 always, and an impact turns the rate v > 0 into -r v at once.
template <class Real>
struct Restitution {
    Real coefficient = 1;  // r, from 0 to 1
};

// Nonlinear spring whose damping grows with the penetration: f = K delta^n (1 + D delta') (Hunt & Crossley
// 1975). Continuous at first touch.
template <class Real>
struct HuntCrossley {
    Real stiffness = 0;    // K A0^(n-1)/k
    Real exponent = 1.5;   // n >= 1; 3/2 for Hertz's contact of spheres
    Real dissipation = 0;  // D A0 omega
};

template <class Real>
using ContactLaw = std::variant<KelvinVoigt<Real>, Restitution<Real>, HuntCrossley<Real>>;

// Whether an impact takes no energy.
template <class Real>
bool is_lossless(const ContactLaw<Real>& law) {
    struct Loss {
        bool operator()(const KelvinVoigt<Real>& stop) const { return stop.damping == 0; }
        bool operator()(const Restitution<Real>& stop) const { return stop.coefficient == 1; }
        bool operator()(const HuntCrossley<Real>& stop) const { return stop.dissipation == 0; }
    };
    return std::visit(Loss{}, law);
}

}  // namespace peterka::scene
