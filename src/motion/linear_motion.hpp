// Closed-form motion of one linear phase: free flight, or contact while the stop presses.
//
//     x'' + 2 b x' + w2 x = s + A sin(theta),   theta = theta0 + eta t,   w2 > 0, b >= 0
//
// The solution is split into the steady harmonic response, the static offset s/w2, and a homogeneous remainder
// propagated by the fundamental matrix. Under-, critically and overdamped phases have one fundamental solution
// each, written without cancellation. Close to resonance the harmonic response is huge and nearly cancels
// against the remainder; there the forced part is the response from rest, whose only difficult factor is
// (exp(z) - 1)/z at small z.
#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

#include "scene/oscillator.hpp"

namespace peterka::motion {

using scene::Jacobian;
using scene::State;

// The coefficients of one linear phase.
template <class Real>
struct LinearEquation {
    Real damping = 0;    // b
    Real stiffness = 1;  // w2
    Real offset = 0;     // s
    Real drive = 0;      // A
    Real frequency = 1;  // eta
};

template <class Real>
LinearEquation<Real> flight_equation(const scene::Oscillator<Real>& oscillator) {
    return {oscillator.damping_ratio, 1, -oscillator.gap, oscillator.drive(), oscillator.frequency};
}

template <class Real>
LinearEquation<Real> contact_equation(const scene::Oscillator<Real>& oscillator) {
    return {oscillator.damping_ratio + oscillator.kelvin_voigt().damping / 2,
            1 + oscillator.kelvin_voigt().stiffness, -oscillator.gap, oscillator.drive(), oscillator.frequency};
}

// A point of a motion: its state, the homogeneous part of it, and the forcing phase.
template <class Real>
struct Moment {
    Real time = 0;  // since the leg began
    State<Real> state = State<Real>::Zero();
    State<Real> homogeneous = State<Real>::Zero();
    Real sine = 0;  // of the forcing phase
    Real cosine = 1;
    Jacobian<Real> flow =
        Jacobian<Real>::Identity();  // derivative of the state by the state at the beginning of the leg
    State<Real> terms =
        State<Real>::Zero();  // sum of the magnitudes of the state's terms: its rounding error over epsilon
    bool split = true;        // whether the state is the sum of its parts to full accuracy
};

template <class Real>
class LinearMotion {
  public:
    using Complex = std::complex<Real>;

    explicit LinearMotion(const LinearEquation<Real>& equation)
        : equation_(equation), natural_frequency_(std::sqrt(equation.stiffness)) {
        const auto& [b, w2, s, drive, eta] = equation_;
        const Real discriminant = (natural_frequency_ - b) * (natural_frequency_ + b);  // w2 - b^2
        oscillates_ = discriminant > 0;
        rate_ = std::sqrt(std::abs(discriminant));
        near_critical_ = std::abs(discriminant) < w2 / 64;
        slow_ = oscillates_ ? -b : -w2 / (b + rate_);
        fast_ = oscillates_ ? -b : -(b + rate_);
        const Complex impedance((natural_frequency_ - eta) * (natural_frequency_ + eta), 2 * b * eta);
        response_ = drive / impedance;
        // The response from rest takes over where the split would lose three digits.
        resonant_ = oscillates_ && std::abs(impedance) < Real(1e-3) * (w2 + eta * eta);
    }

    [[nodiscard]] const LinearEquation<Real>& equation() const { return equation_; }
    [[nodiscard]] Real natural_frequency() const { return natural_frequency_; }
    [[nodiscard]] bool oscillates() const { return oscillates_; }
    [[nodiscard]] bool near_critical() const { return near_critical_; }
    [[nodiscard]] bool resonant() const { return resonant_; }
    [[nodiscard]] Real rate() const {
        return rate_;
    }  // damped frequency, or half the distance between the two real rates
    [[nodiscard]] Real slow() const { return slow_; }  // real parts of the two exponents, slow() >= fast()
    [[nodiscard]] Real fast() const { return fast_; }
    [[nodiscard]] Real rest() const { return equation_.offset / equation_.stiffness; }  // static position
    // Steady response: x = Im(response exp(i theta)). Infinite at undamped resonance.
    [[nodiscard]] Complex response() const { return response_; }

    // Fundamental matrix: (x, x') at t of the homogeneous motion, from (x, x') at 0.
    [[nodiscard]] Jacobian<Real> flow(Real t) const {
        Real cosine_like = 0;  // x(t) from x = 1, x' = 0
        Real sine_like = 0;    // x(t) from x = 0, x' = 1
        Real slope = 0;        // derivative of sine_like
        if (oscillates_) {
            const Real decay = std::exp(slow_ * t);
            const Real swing = decay * std::cos(rate_ * t);
            sine_like = decay * std::sin(rate_ * t) / rate_;
            cosine_like = swing + equation_.damping * sine_like;
            slope = swing - equation_.damping * sine_like;
        } else {
            const Real decay = std::exp(fast_ * t);
            const Real spread = rate_ > 0 ? -std::expm1(-2 * rate_ * t) / (2 * rate_) : t;
            sine_like = std::exp(slow_ * t) * spread;
            cosine_like = decay - fast_ * sine_like;
            slope = decay + slow_ * sine_like;
        }
        Jacobian<Real> matrix;
        matrix << cosine_like, sine_like, -equation_.stiffness * sine_like, slope;
        return matrix;
    }

    // Steady response (x, x') at a forcing phase of given sine and cosine.
    [[nodiscard]] State<Real> steady(Real sine, Real cosine) const {
        const Real re = response_.real();
        const Real im = response_.imag();
        return {re * sine + im * cosine, equation_.frequency * (re * cosine - im * sine)};
    }

    // Response from rest after time t to A sin(theta0 + eta t); for |resonance distance| * t small.
    [[nodiscard]] State<Real> from_rest(Real t, Real sine0, Real cosine0) const {
        const Complex exponent(slow_, rate_);
        const Complex drive_exponent(0, equation_.frequency);
        const Complex turn(cosine0, sine0);
        const Complex decay = std::exp(exponent * t);
        const Complex near = decay * t * relative_growth((drive_exponent - exponent) * t);
        const Complex far = (std::exp(-drive_exponent * t) - decay) / (-drive_exponent - exponent);
        // mode = (x' + b x) + i rate x obeys mode' = exponent * mode + A sin(theta)
        const Complex mode = equation_.drive * (turn * near - std::conj(turn) * far) / Complex(0, 2);
        const Real x = mode.imag() / rate_;
        return {x, mode.real() - equation_.damping * x};
    }

    // Within this time after its start a motion is summed as a power series.
    [[nodiscard]] Real short_time() const {
        return 1 / (8 * std::max(natural_frequency_ + 2 * equation_.damping, equation_.frequency));
    }

    // State after a short time t, by the power series whose coefficients follow from the equation.
    [[nodiscard]] State<Real> series(Real t, const State<Real>& start, Real sine0, Real cosine0) const {
        const auto& [b, w2, s, drive, eta] = equation_;
        Real term = start[0];       // coefficient of t^n times t^n
        Real next = start[1] * t;   // the same for t^(n+1)
        Real wave = drive * sine0;  // the same for the forcing
        Real next_wave = drive * eta * t * cosine0;
        Real force = (wave + s) * t * t;
        State<Real> sum(start[0] + next, start[1]);
        for (int n = 0; n < 12; ++n) {
            const Real after =
                (force - 2 * b * t * Real(n + 1) * next - w2 * t * t * term) / Real((n + 1) * (n + 2));
            sum += State<Real>(after, Real(n + 2) * after / t);
            term = next;
            next = after;
            const Real wave_after = -eta * eta * t * t * wave / Real((n + 1) * (n + 2));
            wave = next_wave;
            next_wave = wave_after;
            force = wave * t * t;
        }
        return sum;
    }

  private:
    // (exp(z) - 1)/z for |z| < 0.1, to the last digit of a 64-bit mantissa.
    static Complex relative_growth(Complex z) {
        Complex sum(1);
        for (int n = 14; n >= 2; --n) sum = Complex(1) + z / Real(n) * sum;
        return sum;
    }

    LinearEquation<Real> equation_;
    Real natural_frequency_;
    Real rate_ = 0;
    Real slow_ = 0;
    Real fast_ = 0;
    Complex response_;
    bool oscillates_ = true;
    bool near_critical_ = false;
    bool resonant_ = false;
};

// One motion from a given state at a given forcing phase, up to the end of its phase or of the forcing cycle.
template <class Real>
class Leg {
  public:
    Leg(const LinearMotion<Real>& motion, const State<Real>& start, Real phase)
        : motion_(&motion), phase_(phase), start_{0,
                                                  start,
                                                  start,
                                                  std::sin(phase),
                                                  std::cos(phase),
                                                  Jacobian<Real>::Identity(),
                                                  start.cwiseAbs(),
                                                  false} {
        start_.homogeneous[0] -= motion.rest();
        if (!motion.resonant()) start_.homogeneous -= motion.steady(start_.sine, start_.cosine);
    }

    [[nodiscard]] const LinearMotion<Real>& motion() const { return *motion_; }
    [[nodiscard]] const Moment<Real>& start() const { return start_; }

    [[nodiscard]] Moment<Real> at(Real t) const {
        const Real angle = phase_ + motion_->equation().frequency * t;
        Moment<Real> m{t, {}, {}, std::sin(angle), std::cos(angle), motion_->flow(t), {}, !motion_->resonant()};
        m.homogeneous = m.flow * start_.homogeneous;
        if (t > 0 && t < motion_->short_time()) {
            m.split = false;
            m.state = motion_->series(t, start_.state, start_.sine, start_.cosine);
            m.terms = start_.terms + State<Real>(start_.terms[1] * t, std::abs(m.state[1] - start_.state[1]));
            return m;
        }
        const State<Real> forced = motion_->resonant() ? motion_->from_rest(t, start_.sine, start_.cosine)
                                                       : motion_->steady(m.sine, m.cosine);
        m.state = m.homogeneous + forced;
        m.state[0] += motion_->rest();
        m.terms = m.homogeneous.cwiseAbs() + forced.cwiseAbs();
        m.terms[0] += std::abs(motion_->rest());
        return m;
    }

  private:
    const LinearMotion<Real>* motion_;
    Real phase_;
    Moment<Real> start_;
};

}  // namespace peterka::motion
