// A number with its derivatives by the nondimensional numbers of a rig: the chain rule, operation by operation
// (A. Griewank and A. Walther, Evaluating Derivatives, SIAM 2008). As the number type of certificate/'s motions
// it differentiates them exactly, in closed form and by Taylor series alike. Comparisons take the value.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "certificate/elementary.hpp"

namespace peterka::elasticity {

// By which numbers; a rigid stop's restitution takes the place of the stiffness.
enum class RigNumber : std::size_t { frequency, gap, damping_ratio, stiffness, damping, cubic };
inline constexpr std::size_t rig_numbers = 6;

struct Dual {
    double value = 0;
    std::array<double, rig_numbers> slopes{};

    constexpr Dual() = default;
    constexpr Dual(double constant) : value(constant) {}  // NOLINT: a double is a number
    Dual(double variable, RigNumber itself) : value(variable) { slopes[static_cast<std::size_t>(itself)] = 1; }
    // A function of one other number, by its value and slope there.
    Dual(double of, double slope, const Dual& x) : value(of) {
        for (std::size_t i = 0; i < rig_numbers; ++i) slopes[i] = slope * x.slopes[i];
    }
    // A function of two.
    Dual(double of, double slope_x, const Dual& x, double slope_y, const Dual& y) : value(of) {
        for (std::size_t i = 0; i < rig_numbers; ++i) slopes[i] = slope_x * x.slopes[i] + slope_y * y.slopes[i];
    }
};

inline Dual operator-(const Dual& x) {
    return {-x.value, -1, x};
}
inline Dual operator+(const Dual& x, const Dual& y) {
    return {x.value + y.value, 1, x, 1, y};
}
inline Dual operator-(const Dual& x, const Dual& y) {
    return {x.value - y.value, 1, x, -1, y};
}
inline Dual operator*(const Dual& x, const Dual& y) {
    return {x.value * y.value, y.value, x, x.value, y};
}
inline Dual operator/(const Dual& x, const Dual& y) {
    const double ratio = x.value / y.value;
    return {ratio, 1 / y.value, x, -ratio / y.value, y};
}
inline Dual exp(const Dual& x) {
    const double power = std::exp(x.value);
    return {power, power, x};
}
inline Dual sqrt(const Dual& x) {
    const double root = std::sqrt(x.value);
    return {root, 0.5 / root, x};
}
inline Dual abs(const Dual& x) {
    return x.value < 0 ? -x : x;
}
inline certificate::SineCosineOf<Dual> sine_cosine(const Dual& angle) {
    const double sine = std::sin(angle.value);
    const double cosine = std::cos(angle.value);
    return {{sine, cosine, angle}, {cosine, -sine, angle}};
}

// What certificate/'s templates ask of a number; it has no radius.
inline bool surely_positive(const Dual& x) {
    return x.value > 0;
}
inline double size_of(const Dual& x) {
    return std::abs(x.value);
}
inline double lowest(const Dual& x) {
    return x.value;
}
inline double highest(const Dual& x) {
    return x.value;
}
inline Dual point_of(const Dual& x) {
    return x;
}
inline double spread_of(const Dual& /*x*/, const Dual& /*point*/) {
    return 0;
}
inline double plus_minus(double /*bound*/, const Dual& /*like*/) {
    return 0;
}
inline Dual box_around(const Dual& middle, double /*radius*/) {
    return middle;
}
inline Dual span_of(const Dual& angle, double /*more*/) {
    return angle;
}

}  // namespace peterka::elasticity
