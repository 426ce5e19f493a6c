// Integrals along a leg by Gauss-Legendre quadrature on pieces that are short relative to the parts of its
// motion still alive.
//
// A piece is no longer than the time in which the fastest living part of the motion (fast or slow transient, or
// the forcing) turns or decays by one radian. Products of two such parts are then exact to about 1e-18 with
// eight nodes. A transient is dead after 40 of its decay times, when it has decayed by a factor of 4e-18; so
// even a stop with zeta_i = 100 and kappa = 1e12, whose rates are 2e8 and 5e3, takes only a few hundred pieces.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "motion/linear_motion.hpp"

namespace peterka::trajectory {

namespace gauss_legendre {
inline constexpr std::array<long double, 4> node = {0.1834346424956498049394761L, 0.5255324099163289858177390L,
                                                    0.7966664774136267395915539L, 0.9602898564975362316835609L};
inline constexpr std::array<long double, 4> weight = {
    0.3626837833783619829651504L, 0.3137066458778872873379622L, 0.2223810344533744705443560L,
    0.1012285362903762591525314L};
}  // namespace gauss_legendre

// The longest piece that begins at this time since the leg began.
template <class Real>
Real quadrature_piece(const motion::LinearMotion<Real>& motion, Real time) {
    constexpr Real dead = 40;  // decay times
    const Real forcing = motion.equation().frequency;
    const bool slow_lives = -motion.slow() * time < dead;
    if (motion.oscillates()) return 1 / std::max(forcing, slow_lives ? motion.natural_frequency() : Real(0));
    const bool fast_lives = -motion.fast() * time < dead;
    const Real transient = fast_lives ? -motion.fast() : slow_lives ? -motion.slow() : Real(0);
    return 1 / std::max(forcing, transient);
}

// The weighted sum of `integrand` over the quadrature nodes of a leg up to the time `end`. The integrand's
// result may be of any type that can be added and multiplied by a number.
template <class Real, class Sum, class Integrand>
Sum integrate_leg(const motion::Leg<Real>& leg, Real end, Sum sum, const Integrand& integrand) {
    for (Real time = 0; time < end;) {
        const Real piece = quadrature_piece(leg.motion(), time);
        const Real half = std::min(piece, end - time) / 2;
        const Real middle = time + half;
        for (std::size_t i = 0; i < gauss_legendre::node.size(); ++i) {
            const Real offset = half * static_cast<Real>(gauss_legendre::node[i]);
            const Real weight = half * static_cast<Real>(gauss_legendre::weight[i]);
            sum += weight * integrand(leg.at(middle - offset));
            sum += weight * integrand(leg.at(middle + offset));
        }
        if (piece >= end - time) break;
        time += piece;
    }
    return sum;
}

}  // namespace peterka::trajectory
