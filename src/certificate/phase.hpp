// The two phases of the hammer, in flight and against the stop:
//     delta'' + c delta' + K delta + r = eta^2 sin(theta) - g,   theta = eta tau,
// with c = 2 zeta and K = 1 in flight, and 2 zeta + chi and 1 + kappa while the stop presses. With linear
// springs r = 0, and a motion is its steady response, -g/K + Im(R exp(i theta)) with R = eta^2/(K - eta^2 + i c
// eta), plus a decaying part. Otherwise r = gamma u^3 or gamma (x^3 - y^3), with u = delta + g, y = sin(theta),
// x = u + y (scene/oscillator.hpp).
//
// Templates over the number type: Interval encloses, double searches.
#pragma once

#include <cmath>
#include <limits>

#include "certificate/elementary.hpp"
#include "certificate/rig.hpp"

namespace peterka::certificate {

template <class Number>
struct Vector {
    Number position = 0;
    Number velocity = 0;
};

template <class Number>
struct Matrix {
    Number a = 1;  // rows (a b), (c d)
    Number b = 0;
    Number c = 0;
    Number d = 1;
};

template <class Number>
Vector<Number> operator*(const Matrix<Number>& m, const Vector<Number>& v) {
    return {m.a * v.position + m.b * v.velocity, m.c * v.position + m.d * v.velocity};
}
template <class Number>
Matrix<Number> operator*(const Matrix<Number>& m, const Matrix<Number>& n) {
    return {m.a * n.a + m.b * n.c, m.a * n.b + m.b * n.d, m.c * n.a + m.d * n.c, m.c * n.b + m.d * n.d};
}
template <class Number>
Matrix<Number> columns(const Vector<Number>& first, const Vector<Number>& second) {
    return {first.position, second.position, first.velocity, second.velocity};
}
template <class Number>
Matrix<Number> inverse(const Matrix<Number>& m) {
    const Number determinant = m.a * m.d - m.b * m.c;
    return {m.d / determinant, -(m.b / determinant), -(m.c / determinant), m.a / determinant};
}
template <class Number>
Vector<Number> operator+(const Vector<Number>& v, const Vector<Number>& w) {
    return {v.position + w.position, v.velocity + w.velocity};
}
template <class Number>
Vector<Number> operator-(const Vector<Number>& v, const Vector<Number>& w) {
    return {v.position - w.position, v.velocity - w.velocity};
}

inline bool surely_positive(double x) {
    return x > 0;
}
inline bool surely_positive(const Interval& x) {
    return x.positive();
}
inline double size_of(double x) {
    return std::abs(x);
}
inline double size_of(const Interval& x) {
    return x.size();
}
inline double lowest(double x) {
    return x;
}
inline double lowest(const Interval& x) {
    return x.lo;
}
inline double plus_minus(double /*bound*/, double /*like*/) {
    return 0;
}
inline Interval plus_minus(double bound, const Interval& /*like*/) {
    return {-bound, bound};
}
// Whether 9 terms of the sines' power series are as good as the number type.
template <class Number>
bool is_small(const Number& x) {
    return size_of(x) < 0.5;
}

template <class Number>
class Phase {
  public:
    Phase(const RigOf<Number>& rig, bool presses)
        : damping_(Number(2) * rig.damping_ratio + (presses ? rig.damping : Number(0))),
          stiffness_(Number(1) + (presses ? rig.stiffness : Number(0))),
          frequency_(rig.frequency),
          drive_(rig.frequency * rig.frequency),
          gap_(rig.gap),
          cubic_(rig.cubic),
          absolute_(rig.absolute),
          half_(damping_ / Number(2)),
          discriminant_(stiffness_ - half_ * half_),
          rest_(-gap_ / stiffness_) {
        const Number in_phase = stiffness_ - drive_;
        const Number behind = damping_ * frequency_;
        const Number share = drive_ / (in_phase * in_phase + behind * behind);
        real_ = share * in_phase;
        imaginary_ = -(share * behind);
        using std::abs;
        using std::sqrt;
        rate_ = sqrt(abs(discriminant_));
        swing_ = size_of(sqrt(real_ * real_ + imaginary_ * imaginary_));
        root_ = lowest(sqrt(stiffness_));
    }

    [[nodiscard]] const Number& damping() const { return damping_; }      // c
    [[nodiscard]] const Number& stiffness() const { return stiffness_; }  // K
    [[nodiscard]] const Number& frequency() const { return frequency_; }  // eta
    [[nodiscard]] const Number& drive() const { return drive_; }          // eta^2
    [[nodiscard]] const Number& rest() const { return rest_; }            // -g/K
    [[nodiscard]] const Number& real() const { return real_; }            // of R
    [[nodiscard]] const Number& imaginary() const { return imaginary_; }  // of R

    [[nodiscard]] bool is_linear() const { return size_of(cubic_) == 0; }
    [[nodiscard]] const Number& cubic() const { return cubic_; }  // gamma
    [[nodiscard]] bool absolute() const { return absolute_; }     // r = gamma (x^3 - y^3)
    [[nodiscard]] const Number& gap() const { return gap_; }
    [[nodiscard]] double root_of_stiffness() const { return root_; }  // lower bound of sqrt(K)
    // Bounds of the springs' cubic part while |u| stays below u, and of its derivative by u.
    [[nodiscard]] double largest_cubic(double u) const {
        return size_of(cubic_) * (absolute_ ? (u + 1) * (u + 1) * (u + 1) + 1 : u * u * u) * 1.000000001;
    }
    [[nodiscard]] double largest_cubic_slope(double u) const {
        return 3 * size_of(cubic_) * (absolute_ ? (u + 1) * (u + 1) : u * u) * 1.000000001;
    }
    [[nodiscard]] double swing() const { return swing_; }  // upper bound of |R|
    // Whether the cubic term may reverse a swing as large as the cart's, or the gap, within a cycle: the bounds
    // of its effect would then be void.
    [[nodiscard]] bool is_too_bent() const {
        const double cycle = size_of(Number(2) * pi.hi / frequency_);
        return !(largest_cubic_slope(size_of(gap_) + 1) * cycle < 1);
    }

    [[nodiscard]] Number acceleration(const Vector<Number>& state, const Number& sine) const {
        Number linear = drive_ * sine - gap_ - damping_ * state.velocity - stiffness_ * state.position;
        if (is_linear()) return linear;
        const Number u = state.position + gap_;
        const Number square = absolute_ ? u * u + Number(3) * sine * (u + sine) : u * u;
        return linear - cubic_ * u * square;
    }
    // Whether the acceleration at rest on the stop rises with sin(theta).
    [[nodiscard]] bool pressing_rises() const {
        if (is_linear() || !absolute_) return true;
        const Number twice = Number(0) + plus_minus(2, gap_);
        return surely_positive(drive_ - Number(3) * cubic_ * gap_ * (twice + gap_));
    }
    [[nodiscard]] Number jerk(const Vector<Number>& state, const Number& acceleration,
                              const SineCosineOf<Number>& angle) const {
        Number linear =
            drive_ * frequency_ * angle.cosine - damping_ * acceleration - stiffness_ * state.velocity;
        if (is_linear()) return linear;
        const Number u = state.position + gap_;
        if (!absolute_) return linear - Number(3) * cubic_ * u * u * state.velocity;
        const Number x = u + angle.sine;
        const Number cart = frequency_ * angle.cosine;
        return linear - Number(3) * cubic_ * (x * x * (state.velocity + cart) - angle.sine * angle.sine * cart);
    }
    [[nodiscard]] Vector<Number> steady(const SineCosineOf<Number>& angle) const {
        return {rest_ + real_ * angle.sine + imaginary_ * angle.cosine,
                frequency_ * (real_ * angle.cosine - imaginary_ * angle.sine)};
    }

    // Propagates a difference of two motions over a time.
    [[nodiscard]] Matrix<Number> flow(const Number& time) const {
        using std::exp;
        const Number turn = discriminant_ * time * time;
        Number swing;      // exp(-c t/2) cos(rate t), or cosh
        Number sine_like;  // exp(-c t/2) sin(rate t)/rate, or sinh
        if (is_small(turn)) {
            const Number decay = exp(-(half_ * time));
            swing = decay * even_series(turn);
            sine_like = decay * time * odd_series(turn);
        } else if (surely_positive(discriminant_)) {
            const Number decay = exp(-(half_ * time));
            const SineCosineOf<Number> angle = sine_cosine(rate_ * time);
            swing = decay * angle.cosine;
            sine_like = decay * angle.sine / rate_;
        } else {
            const Number fast = exp(-((half_ + rate_) * time));
            const Number slow = exp(-(stiffness_ / (half_ + rate_) * time));
            swing = (slow + fast) / Number(2);
            sine_like = (slow - fast) / (Number(2) * rate_);
        }
        const Number part = half_ * sine_like;
        return {swing + part, sine_like, -(stiffness_ * sine_like), swing - part};
    }

    // A flow of the linear phase, widened by the effect of a cubic term of at most this slope: by Duhamel's
    // formula at most e = |s| t/sqrt(K) in the length sqrt(v^2 + K x^2), times exp(e).
    [[nodiscard]] Matrix<Number> changed(const Matrix<Number>& flow, const Number& time, double slope) const {
        if (is_linear()) return flow;
        constexpr double above = 1 + 1e-12;
        const double change = slope * size_of(time) / root_;
        const double error = change < 1 ? change * (1 + change + change * change) * above
                                        : std::numeric_limits<double>::infinity();
        const double large_root = std::sqrt(size_of(stiffness_)) * above;
        return {flow.a + plus_minus(error, flow.a), flow.b + plus_minus(error / root_ * above, flow.b),
                flow.c + plus_minus(error * large_root, flow.c), flow.d + plus_minus(error, flow.d)};
    }

  private:
    // For |z| < 1/2, the sums of (-z)^n/(2n)! and of (-z)^n/(2n+1)!, whose remainders after n = 8 are below
    // z^9/18! and z^9/19!.
    static Number even_series(const Number& z) {
        Number sum(1);
        for (int n = 8; n > 0; --n) sum = Number(1) - z * sum / Number((2.0 * n - 1) * (2.0 * n));
        return sum + plus_minus(4e-19, z);
    }
    static Number odd_series(const Number& z) {
        Number sum(1);
        for (int n = 8; n > 0; --n) sum = Number(1) - z * sum / Number((2.0 * n) * (2.0 * n + 1));
        return sum + plus_minus(4e-20, z);
    }

    Number damping_;
    Number stiffness_;
    Number frequency_;
    Number drive_;
    Number gap_;
    Number cubic_;
    bool absolute_;
    Number half_;
    Number discriminant_;
    Number rest_;
    Number rate_ = 0;
    Number real_ = 0;
    Number imaginary_ = 0;
    double swing_ = 0;
    double root_ = 0;
};

}  // namespace peterka::certificate
