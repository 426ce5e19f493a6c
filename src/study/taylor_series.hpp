// A step of a trajectory as a power series of time, and the force of each contact law as one.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "scene/contact_law.hpp"

namespace peterka::study::taylor {

using Real = long double;
inline constexpr std::size_t order = 24;
using Series = std::array<Real, order + 1>;  // coefficients of delta(t)

struct Point {
    Real position = 0;  // delta
    Real velocity = 0;
};

inline Point at(const Series& series, Real t) {
    Point p;
    for (std::size_t n = order + 1; n-- > 0;) {
        p.velocity = p.velocity * t + p.position;
        p.position = p.position * t + series[n];
    }
    return p;
}

inline Real acceleration_at(const Series& series, Real t) {
    Real a = 0;
    for (std::size_t n = order; n >= 2; --n) a = a * t + Real(n * (n - 1)) * series[n];
    return a;
}

// Each force is built up along with the motion: coefficient(series, n) needs delta up to the power n + 1.

class KelvinVoigtForce {
  public:
    explicit KelvinVoigtForce(const scene::KelvinVoigt<Real>& law) : law_(law) {}

    Real coefficient(const Series& series, std::size_t n) {
        return law_.stiffness * series[n] + law_.damping * Real(n + 1) * series[n + 1];
    }
    [[nodiscard]] Real value(const Point& p) const {
        return law_.stiffness * p.position + law_.damping * p.velocity;
    }
    [[nodiscard]] Real slope(const Point& p, Real acceleration) const {
        return law_.stiffness * p.velocity + law_.damping * acceleration;
    }
    // Positive while the stop presses.
    [[nodiscard]] Real pressing(const Point& p) const { return value(p); }
    [[nodiscard]] Real fastest_rate(const Point&) const { return std::sqrt(law_.stiffness) + law_.damping; }
    // Depth below which the force has no effect.
    [[nodiscard]] Real floor(Real, Real) const { return 0; }
    [[nodiscard]] bool is_analytic() const { return true; }

  private:
    scene::KelvinVoigt<Real> law_;
};

class HuntCrossleyForce {
  public:
    explicit HuntCrossleyForce(const scene::HuntCrossley<Real>& law) : law_(law) {}

    // p = delta^n obeys delta p' = n delta' p, which gives the coefficients of p one after another (Knuth,
    // TAOCP 2, sec. 4.7).
    Real coefficient(const Series& series, std::size_t n) {
        Real power = 0;
        if (n == 0) {
            power = std::pow(series[0], law_.exponent);
        } else {
            for (std::size_t j = 1; j <= n; ++j) {
                power += (law_.exponent * Real(j) - Real(n - j)) * series[j] * powers_[n - j];
            }
            power /= Real(n) * series[0];
        }
        powers_[n] = power;
        Real force = power;
        for (std::size_t j = 0; j <= n; ++j) {
            force += law_.dissipation * powers_[j] * Real(n - j + 1) * series[n - j + 1];
        }
        return law_.stiffness * force;
    }
    [[nodiscard]] Real value(const Point& p) const {
        if (!(p.position > 0)) return 0;
        return law_.stiffness * std::pow(p.position, law_.exponent) * pressing(p);
    }
    [[nodiscard]] Real slope(const Point& p, Real acceleration) const {
        if (!(p.position > 0)) return 0;
        const Real power = law_.stiffness * std::pow(p.position, law_.exponent);
        return power *
               (law_.exponent * p.velocity / p.position * pressing(p) + law_.dissipation * acceleration);
    }
    [[nodiscard]] Real pressing(const Point& p) const { return 1 + law_.dissipation * p.velocity; }
    [[nodiscard]] Real fastest_rate(const Point& p) const {
        const Real depth = std::max(p.position, Real(0));
        const Real power = law_.stiffness * std::pow(depth, law_.exponent - 1);
        return std::sqrt(2 * law_.exponent * power * (1 + law_.dissipation * std::abs(p.velocity))) +
               2 * power * depth * law_.dissipation;
    }
    // Below it, the force's whole effect on the way to delta = 0 is lost in the velocity or the acceleration.
    [[nodiscard]] Real floor(Real velocity, Real acceleration) const {
        constexpr Real lost = 1e-20L;
        const Real strength = law_.stiffness * (1 + law_.dissipation * std::abs(velocity));
        const Real by_velocity = std::pow(lost * velocity * velocity / strength, 1 / (law_.exponent + 1));
        const Real by_acceleration = std::pow(lost * std::abs(acceleration) / strength, 1 / law_.exponent);
        return std::max(by_velocity, by_acceleration);
    }
    [[nodiscard]] bool is_analytic() const { return false; }

  private:
    scene::HuntCrossley<Real> law_;
    Series powers_{};
};

}  // namespace peterka::study::taylor
