// The contact laws of the stop: one small struct for each law, nondimensional.
//
// delta is the penetration in A0, delta' its rate in A0 omega, f the force on the hammer in k A0. The stop
// never pulls: f is 0 where a formula gives less, and everywhere for delta <= 0.
#pragma once

#include <variant>

#include "job/derived.hpp"
#include "job/job.hpp"

namespace peterka::scene {

// Spring and dashpot: f = kappa delta + chi delta' (eqs. 5-12 of Aguiar & Weber).
template <class Real>
struct KelvinVoigt {
    using Given = job::KelvinVoigt;
    static constexpr bool has_smooth_force = true;
    Real stiffness = 0;  // kappa = ki/k
    Real damping = 0;    // chi = ci/(m omega)

    static KelvinVoigt of(const Given& stop, const job::Hammer& hammer, const job::Cart& /*cart*/) {
        const auto numbers = job::derive(stop, hammer);
        return {numbers.kappa, numbers.chi};
    }
    template <class To>
    [[nodiscard]] KelvinVoigt<To> as() const {
        return {static_cast<To>(stiffness), static_cast<To>(damping)};
    }
    [[nodiscard]] bool is_lossless() const { return damping == 0; }
    [[nodiscard]] bool lets_go_at_surface() const { return damping == 0; }
    void move_to_release(Real& position, const Real& velocity) const {
        position = -damping / stiffness * velocity;
    }
};

// A rigid stop: delta <= 0 always, and an impact changes the rate v > 0 to -r v instantaneously.
template <class Real>
struct Restitution {
    using Given = job::Restitution;
    static constexpr bool has_smooth_force = true;
    Real coefficient = 1;  // coefficient of restitution r, from 0 to 1

    static Restitution of(const Given& stop, const job::Hammer& /*hammer*/, const job::Cart& /*cart*/) {
        return {stop.coefficient};
    }
    template <class To>
    [[nodiscard]] Restitution<To> as() const {
        return {static_cast<To>(coefficient)};
    }
    [[nodiscard]] bool is_lossless() const { return coefficient == 1; }
    [[nodiscard]] bool lets_go_at_surface() const { return true; }
    void move_to_release(Real& /*position*/, const Real& /*velocity*/) const {}
};

// Nonlinear spring whose damping grows with the penetration: f = K delta^n (1 + D delta') (Hunt & Crossley
// 1975). Continuous at first touch.
template <class Real>
struct HuntCrossley {
    using Given = job::HuntCrossley;
    static constexpr bool has_smooth_force = false;
    Real stiffness = 0;    // K A0^(n-1)/k
    Real exponent = 1.5;   // n >= 1; 3/2 for Hertzian contact of spheres
    Real dissipation = 0;  // D A0 omega

    static HuntCrossley of(const Given& stop, const job::Hammer& hammer, const job::Cart& cart) {
        const auto numbers = job::derive(stop, hammer, cart);
        return {numbers.stiffness, stop.exponent, numbers.dissipation};
    }
    template <class To>
    [[nodiscard]] HuntCrossley<To> as() const {
        return {static_cast<To>(stiffness), static_cast<To>(exponent), static_cast<To>(dissipation)};
    }
    [[nodiscard]] bool is_lossless() const { return dissipation == 0; }
    [[nodiscard]] bool lets_go_at_surface() const { return true; }
    void move_to_release(const Real& /*position*/, Real& velocity) const { velocity = -1 / dissipation; }
};

template <class Real>
using ContactLaw = std::variant<KelvinVoigt<Real>, Restitution<Real>, HuntCrossley<Real>>;

// Whether an impact dissipates no energy.
template <class Real>
bool is_lossless(const ContactLaw<Real>& law) {
    return std::visit([](const auto& stop) { return stop.is_lossless(); }, law);
}

// See the laws of the job (job/job.hpp).
template <class Real>
bool is_rigid(const ContactLaw<Real>& law) {
    return std::visit([]<class Law>(const Law&) { return Law::Given::is_rigid; }, law);
}
template <class Real>
bool has_closed_form(const ContactLaw<Real>& law) {
    return std::visit([]<class Law>(const Law&) { return Law::Given::has_closed_form; }, law);
}

// Whether all derivatives of the force are bounded up to delta = 0, as high-order methods require.
template <class Real>
bool has_smooth_force(const ContactLaw<Real>& law) {
    return std::visit([]<class Law>(const Law&) { return Law::has_smooth_force; }, law);
}

// The contact law that the job gives, in nondimensional numbers.
inline ContactLaw<double> law_of(const job::Contact& contact, const job::Hammer& hammer,
                                 const job::Cart& cart) {
    const auto fill = [&]<class... Laws>(const std::variant<Laws...>* /*all*/) {
        ContactLaw<double> law;
        const auto take = [&]<class Law>(const Law* /*which*/) {
            if (const auto* given = std::get_if<typename Law::Given>(&contact))
                law = Law::of(*given, hammer, cart);
        };
        (take(static_cast<const Laws*>(nullptr)), ...);
        return law;
    };
    return fill(static_cast<const ContactLaw<double>*>(nullptr));
}

}  // namespace peterka::scene
