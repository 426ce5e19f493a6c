// A rigid stop with a coefficient of restitution r: the events at delta = 0, whatever carries the hammer there.
//
// - The hammer at rest on the stop has the acceleration a(theta) = eta^2 sin(theta) - g - cubic part, a
//   polynomial in s = sin(theta). Where a > 0 it presses the hammer against the stop, with the force f = a.
// - Impact: v > 0 becomes -r v. A small change of the state before becomes, after it (saltation matrix, see
//   Leine & Nijmeijer 2004),
//       [[-r, 0], [(1 + r) a/v, -r]];
//   the damper's forces before and after the impact cancel in it.
// - Chatter: while a > 0 and r < 1 impacts follow each other ever faster and end in rest after a finite time
//   (Budd & Dux 1994). From a rebound speed w on, with sigma = w/(a (1 - r)) and zeta the damping of the
//   flight,
//       time to rest = 2 sigma (1 - (2/3) sigma (zeta + a'/a) + O(sigma^2)).
//   (One flight lasts 2 w/a - (4/3) (zeta a + a') w^2/a^3 and comes back with
//   w + (2/3) (a' - 2 zeta a) w^2/a^2, a' = da/dtau; the sum over the flights follows order by order.)
// - Sticking: at rest while a > 0, released where a falls through 0. The release is determined by the phase
//   alone.
//
// Chatter is followed impact by impact until the series' error is lost in rounding; that takes about 14/(1 - r)
// impacts from a hop as long as the natural period.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "motion/linear_motion.hpp"
#include "scene/oscillator.hpp"

namespace peterka::trajectory {

template <class Real>
class RigidStop {
  public:
    // a = constant + linear s + quadratic s^2, s = sin(theta).
    struct Pressing {
        Real constant = 0;
        Real linear = 0;
        Real quadratic = 0;
    };

    RigidStop(Real restitution, Real damping_ratio, Real frequency, const Pressing& pressing)
        : restitution_(restitution), damping_(damping_ratio), frequency_(frequency), pressing_(pressing) {
        find_zeros();
    }
    // The stop of an oscillator, its cubic springs included.
    explicit RigidStop(const scene::Oscillator<Real>& oscillator)
        : RigidStop(restitution_of(oscillator), oscillator.damping_ratio, oscillator.frequency,
                    pressing_of(oscillator)) {}
    // The same for springs described by a linear equation.
    RigidStop(const scene::Oscillator<Real>& oscillator, const motion::LinearEquation<Real>& flight)
        : RigidStop(restitution_of(oscillator), flight.damping, flight.frequency,
                    {.constant = flight.offset, .linear = flight.drive}) {}

    [[nodiscard]] Real restitution() const { return restitution_; }
    [[nodiscard]] Real frequency() const { return frequency_; }

    // a at rest on the stop.
    [[nodiscard]] Real acceleration(Real theta) const { return at_sine(std::sin(theta)); }
    // Integral of a over the time from one phase to another; negative if the latter comes first.
    [[nodiscard]] Real impulse(Real from, Real to) const {
        const Real half = (to - from) / 2;
        const Real middle = from + half;
        const Real wave = 2 * std::sin(middle) * std::sin(half);                   // cos(from) - cos(to)
        const Real square = half - std::cos(2 * middle) * std::sin(2 * half) / 2;  // integral of sin^2
        return (2 * pressing_.constant * half + pressing_.linear * wave + pressing_.quadratic * square) /
               frequency_;
    }
    // Largest a in a stretch of pressing.
    [[nodiscard]] Real largest(Real from, Real to) const {
        Real largest = std::max(acceleration(from), acceleration(to));
        for (const Real top : {Real(0.5), Real(1.5)}) {  // of pi: where the sine turns
            const Real turn = top * std::numbers::pi_v<Real>;
            if (ahead(from, turn) <= to - from) largest = std::max(largest, acceleration(turn));
        }
        const Real vertex = -pressing_.linear / (2 * pressing_.quadratic);
        if (!(std::abs(vertex) < 1)) return largest;
        for (const Real turn : {std::asin(vertex), std::numbers::pi_v<Real> - std::asin(vertex)}) {
            if (ahead(from, turn) <= to - from) largest = std::max(largest, at_sine(vertex));
        }
        return largest;
    }

    // How far ahead of a phase a falls through zero, 0 included, and rises through it, 0 excluded; infinite if
    // it never does. Which of the two comes first tells whether the hammer is pressed, so that rounding can't
    // make it miss its release.
    [[nodiscard]] Real ahead_to_release(Real theta) const { return nearest(theta, falls_); }
    [[nodiscard]] Real ahead_to_pressing(Real theta) const {
        Real nearest = std::numeric_limits<Real>::infinity();
        for (std::size_t i = 0; i < zeros_; ++i) {
            const Real distance = ahead(theta, rises_[i]);
            nearest = std::min(nearest, distance > 0 ? distance : full_turn);
        }
        return nearest;
    }
    [[nodiscard]] bool presses(Real theta) const {
        if (zeros_ == 0) return at_sine(0) > 0;
        return ahead_to_release(theta) < ahead_to_pressing(theta);
    }
    [[nodiscard]] bool always_presses() const { return zeros_ == 0 && at_sine(0) > 0; }

    // Derivative of the state after an impact at speed v with respect to the state before.
    [[nodiscard]] scene::Jacobian<Real> saltation(Real theta, Real v) const {
        scene::Jacobian<Real> matrix;
        matrix << -restitution_, 0, (1 + restitution_) * acceleration(theta) / v, -restitution_;
        return matrix;
    }

    // Time from a rebound at speed w to rest on the stop that presses; nothing if the series isn't exact to
    // rounding yet.
    [[nodiscard]] std::optional<Real> time_to_rest(Real theta, Real w) const {
        if (w == 0) return Real(0);
        const Real a = acceleration(theta);
        const Real sigma = w / (a * (1 - restitution_));
        const Real sine = std::sin(theta);
        const Real slope = frequency_ * std::cos(theta) * (pressing_.linear + 2 * pressing_.quadratic * sine);
        const Real bend =
            frequency_ * frequency_ * (std::abs(pressing_.linear) + 2 * std::abs(pressing_.quadratic));
        const Real rate = 1 + damping_ + frequency_ + std::abs(slope) / a + std::sqrt(bend / a);
        // the error is about sigma (sigma rate)^2, or (sigma rate)^3 in units of 1/rate
        static const Real small = std::cbrt(std::numeric_limits<Real>::epsilon()) / 8;
        if (!(a > 0) || !(sigma * rate < small)) return std::nullopt;
        return 2 * sigma * (1 - sigma * (damping_ + slope / a) * 2 / 3);
    }

  private:
    static constexpr Real full_turn = 2 * std::numbers::pi_v<Real>;

    static Real restitution_of(const scene::Oscillator<Real>& oscillator) {
        return oscillator.restitution().coefficient;
    }
    static Pressing pressing_of(const scene::Oscillator<Real>& oscillator) {
        const Real g = oscillator.gap;
        Pressing pressing{.constant = -g * (1 + oscillator.cubic * g * g), .linear = oscillator.drive()};
        if (oscillator.cubic_form == job::CubicForm::absolute) {
            pressing.linear -= 3 * oscillator.cubic * g * g;
            pressing.quadratic = -3 * oscillator.cubic * g;
        }
        return pressing;
    }

    [[nodiscard]] Real at_sine(Real s) const {
        return pressing_.constant + s * (pressing_.linear + s * pressing_.quadratic);
    }

    // From one phase ahead to the next occurrence of another, from 0 to below a full turn.
    static Real ahead(Real theta, Real target) {
        const Real distance = std::fmod(target - theta, full_turn);
        return distance < 0 ? distance + full_turn : distance;
    }
    [[nodiscard]] Real nearest(Real theta, const std::array<Real, 2>& targets) const {
        Real nearest = std::numeric_limits<Real>::infinity();
        for (std::size_t i = 0; i < zeros_; ++i) nearest = std::min(nearest, ahead(theta, targets[i]));
        return nearest;
    }

    // For each simple root s in (-1, 1) of a, a crosses zero once while the sine rises and once while it falls.
    void find_zeros() {
        const auto& [c, b, q] = pressing_;
        const Real root = std::sqrt(b * b - 4 * q * c);
        const Real larger = -(b + std::copysign(root, b)) / 2;
        for (const Real s : {c / larger, larger / q}) {
            const Real slope = b + 2 * q * s;
            if (!(std::abs(s) < 1) || slope == 0) continue;
            const Real up = std::asin(s);
            const Real down = std::numbers::pi_v<Real> - up;
            rises_[zeros_] = slope > 0 ? up : down;
            falls_[zeros_] = slope > 0 ? down : up;
            ++zeros_;
        }
    }

    Real restitution_;
    Real damping_;
    Real frequency_;
    Pressing pressing_;
    std::array<Real, 2> rises_{};  // phases at which a rises, or falls, through zero
    std::array<Real, 2> falls_{};
    std::size_t zeros_ = 0;
};

}  // namespace peterka::trajectory
