// Signals: affine functions of state and forcing whose zeros are the events of a trajectory.
//
// Along a linear phase the derivative of a signal is a signal again, and a bound on it over all later times
// follows from the homogeneous part (which only decays) and the steady response. Together they make the event
// search safe: see trajectory/first_crossing.hpp.
#pragma once

#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>

#include "motion/linear_motion.hpp"

namespace peterka::motion {

// position * x + velocity * x' + sine * sin(theta) + cosine * cos(theta) + constant
template <class Real>
struct Signal {
    Real position = 0;
    Real velocity = 0;
    Real sine = 0;
    Real cosine = 0;
    Real constant = 0;

    [[nodiscard]] Real operator()(const Moment<Real>& m) const {
        return position * m.state[0] + velocity * m.state[1] + sine * m.sine + cosine * m.cosine + constant;
    }
    [[nodiscard]] Real of_homogeneous(const State<Real>& x) const { return position * x[0] + velocity * x[1]; }
    [[nodiscard]] Signal operator-() const { return {-position, -velocity, -sine, -cosine, -constant}; }
};

template <class Real>
Signal<Real> derivative(const Signal<Real>& signal, const LinearEquation<Real>& phase) {
    return {-phase.stiffness * signal.velocity, signal.position - 2 * phase.damping * signal.velocity,
            phase.drive * signal.velocity - phase.frequency * signal.cosine, phase.frequency * signal.sine,
            phase.offset * signal.velocity};
}

// A signal watched along one linear phase: its value and derivatives, and bounds on them that hold for all
// later times.
template <class Real>
class Probe {
  public:
    Probe(const Signal<Real>& signal, const LinearMotion<Real>& motion)
        : stiffness_(motion.equation().stiffness),
          damping_(motion.equation().damping),
          rate_(motion.rate()),
          slow_(motion.slow()),
          fast_(motion.fast()),
          rest_(signal.position * motion.rest() + signal.constant),
          bound_(motion.near_critical() ? Bound::energy
                                        : (motion.oscillates() ? Bound::amplitude : Bound::modes)) {
        const Complex turn(0, motion.equation().frequency);
        derivative_[0] = signal;
        steady_[0] = motion.response() * (signal.position + turn * signal.velocity) +
                     Complex(signal.sine, signal.cosine);
        for (std::size_t n = 1; n < orders; ++n) {
            derivative_[n] = derivative(derivative_[n - 1], motion.equation());
            steady_[n] = turn * steady_[n - 1];
        }
        swing_ = std::abs(steady_[0]);
        for (std::size_t n = 0; n < orders; ++n) {
            steady_size_[n] = motion.resonant() ? size_from_rest(derivative_[n], motion)
                                                : swing_ * power(motion.equation().frequency, n);
            set_weights(n, motion.natural_frequency());
        }
    }

    [[nodiscard]] Real value(const Moment<Real>& m) const {
        return evaluate(0, m) + (m.split ? rest_ : Real(0));
    }
    [[nodiscard]] Real slope(const Moment<Real>& m) const { return evaluate(1, m); }
    [[nodiscard]] Real curvature(const Moment<Real>& m) const { return evaluate(2, m); }
    [[nodiscard]] const Signal<Real>& slope_signal() const { return derivative_[1]; }

    // Rounding error of value(): smaller values cannot be distinguished from zero.
    [[nodiscard]] Real resolution(const Moment<Real>& m) const {
        return 4 * std::numeric_limits<Real>::epsilon() *
               (std::abs(derivative_[0].position) * m.terms[0] +
                std::abs(derivative_[0].velocity) * m.terms[1]);
    }

    // Bounds on |second| and |third derivative| at this and every later time of the leg.
    struct Bounds {
        Real curvature;
        Real jerk;
    };
    [[nodiscard]] Bounds bounds(const Moment<Real>& m) const {
        const Decaying rest = decaying(m.homogeneous);
        return {steady_size_[2] + reach(rest, 2), steady_size_[3] + reach(rest, 3)};
    }

    // The steady signal oscillates between rest() - swing() and rest() + swing(); the decaying part of a state
    // stays within transient() of its homogeneous part.
    [[nodiscard]] Real rest() const { return rest_; }
    [[nodiscard]] Real swing() const { return swing_; }  // infinite at undamped resonance
    [[nodiscard]] Real transient(const State<Real>& homogeneous) const {
        return reach(decaying(homogeneous), 0);
    }

  private:
    using Complex = std::complex<Real>;
    static constexpr std::size_t orders = 4;  // of derivatives, from 0

    // What bounds the homogeneous part: the amplitude of its oscillation, its two real modes, or, close to
    // critical damping where both are ill-defined, the energy v^2 + w2 x^2, which never grows.
    enum class Bound { amplitude, modes, energy };
    struct Decaying {
        Real slow;
        Real fast;
    };

    // By the split into a decaying and a steady part: in a stiff contact the terms of the plain expression
    // nearly cancel. Where the split itself would cancel, the phase is not stiff or the time is short.
    [[nodiscard]] Real evaluate(std::size_t order, const Moment<Real>& m) const {
        if (!m.split) return derivative_[order](m);
        return derivative_[order].of_homogeneous(m.homogeneous) + steady_[order].real() * m.sine +
               steady_[order].imag() * m.cosine;
    }

    // In a leg of at most one forcing cycle the response from rest is no larger than drive times the cycle's
    // length.
    static Real size_from_rest(const Signal<Real>& s, const LinearMotion<Real>& motion) {
        const Real cycle = 2 * std::numbers::pi_v<Real> / motion.equation().frequency;
        const Real mode = motion.equation().drive * cycle;
        return (std::abs(s.position) + std::abs(s.velocity) * (motion.rate() + motion.equation().damping)) *
                   mode / motion.rate() +
               std::abs(s.sine) + std::abs(s.cosine);
    }

    [[nodiscard]] Decaying decaying(const State<Real>& x) const {
        if (bound_ == Bound::energy) return {std::sqrt(x[1] * x[1] + stiffness_ * x[0] * x[0]), 0};
        const Real value = derivative_[0].of_homogeneous(x);
        const Real slope = derivative_[1].of_homogeneous(x);
        if (bound_ == Bound::modes) {
            return {std::abs(slope - fast_ * value) / (2 * rate_),
                    std::abs(slope - slow_ * value) / (2 * rate_)};
        }
        const Real quadrature = (slope + damping_ * value) / rate_;
        return {std::sqrt(value * value + quadrature * quadrature), 0};
    }

    // Bound on the n-th derivative of the homogeneous part, now and later.
    [[nodiscard]] Real reach(const Decaying& rest, std::size_t n) const {
        return rest.slow * slow_weight_[n] + rest.fast * fast_weight_[n];
    }

    static Real power(Real base, std::size_t n) {
        Real product = 1;
        for (; n > 0; --n) product *= base;
        return product;
    }

    void set_weights(std::size_t n, Real natural_frequency) {
        fast_weight_[n] = power(-fast_, n);
        switch (bound_) {
            case Bound::amplitude:
                slow_weight_[n] = power(natural_frequency, n);
                return;
            case Bound::modes:
                slow_weight_[n] = power(-slow_, n);
                return;
            case Bound::energy:
                slow_weight_[n] =
                    std::abs(derivative_[n].position) / natural_frequency + std::abs(derivative_[n].velocity);
        }
    }

    std::array<Signal<Real>, orders> derivative_;
    std::array<Complex, orders>
        steady_;  // the steady signal is rest + Im(steady exp(i theta)), and likewise its derivatives
    std::array<Real, orders> steady_size_{};
    std::array<Real, orders> slow_weight_{};
    std::array<Real, orders> fast_weight_{};
    Real stiffness_;
    Real damping_;
    Real rate_;
    Real slow_;
    Real fast_;
    Real rest_;
    Real swing_ = 0;
    Bound bound_;
};

}  // namespace peterka::motion
