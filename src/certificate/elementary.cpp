#include "certificate/elementary.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace peterka::certificate {
namespace {

// 1/n!: n! is a double up to 22!.
constexpr std::size_t factorials = 20;
std::array<Interval, factorials> inverse_factorials() {
    std::array<Interval, factorials> inverse;
    double factorial = 1;
    for (std::size_t n = 0; n < factorials; ++n) {
        if (n > 0) factorial *= static_cast<double>(n);
        inverse[n] = outward(1 / factorial, 1 / factorial);
    }
    return inverse;
}
const std::array<Interval, factorials> inverse_factorial = inverse_factorials();

// The leading parts have 33 bits: their products with integers below 2^20 are exact.
constexpr double ln2_leading = 0x1.62e42fee00000p-1;
constexpr Interval ln2_rest{0x1.a39ef35793c76p-33, 0x1.a39ef35793c77p-33};
constexpr double right_angle_leading = 0x1.921fb54400000p+0;
constexpr double right_angle_next = 0x1.0b4611a600000p-34;
constexpr Interval right_angle_rest{0x1.3198a2e037073p-69, 0x1.3198a2e037074p-69};

Interval exp_of(double x) {
    const double multiple = std::nearbyint(x * 1.4426950408889634);
    const Interval rest = Interval(x) - Interval(multiple * ln2_leading) - Interval(multiple) * ln2_rest;
    if (!(rest.size() < 0.36)) return nothing();
    // For |r| < 0.36 the remainder r^14/14! e^r is below 1.1e-17.
    Interval sum = inverse_factorial[13];
    for (std::size_t n = 13; n-- > 0;) sum = inverse_factorial[n] + rest * sum;
    sum += Interval(-1.1e-17, 1.1e-17);
    const int exponent = static_cast<int>(multiple);
    return {std::ldexp(sum.lo, exponent), std::ldexp(sum.hi, exponent)};  // exact: no result is subnormal
}

SineCosine sine_cosine_of(double angle) {
    const double multiple = std::nearbyint(angle * 0.6366197723675814);
    const Interval rest = Interval(angle) - Interval(multiple * right_angle_leading) -
                          Interval(multiple * right_angle_next) - Interval(multiple) * right_angle_rest;
    if (!(rest.size() < 0.8)) return {{-1, 1}, {-1, 1}};
    // Alternating series with decreasing terms: the remainder is below the first omitted term, 0.8^19/19! <
    // 1.2e-19 and 0.8^20/20! < 4.8e-21.
    const Interval minus_square = -square(rest);
    Interval sine = inverse_factorial[17];
    for (std::size_t n = 17; n > 1; n -= 2) sine = inverse_factorial[n - 2] + minus_square * sine;
    sine = rest * sine + Interval(-1.2e-19, 1.2e-19);
    Interval cosine = inverse_factorial[18];
    for (std::size_t n = 18; n > 0; n -= 2) cosine = inverse_factorial[n - 2] + minus_square * cosine;
    cosine += Interval(-4.8e-21, 4.8e-21);
    switch (static_cast<std::int64_t>(multiple) & 3) {
        case 0:
            return {sine, cosine};
        case 1:
            return {cosine, -sine};
        case 2:
            return {-sine, -cosine};
        default:
            return {-cosine, sine};
    }
}

// The slopes of sine and cosine are at most 1.
Interval widened(const Interval& at_middle, double radius) {
    const Interval x = at_middle + Interval(-radius, radius);
    return {std::max(x.lo, -1.0), std::min(x.hi, 1.0)};
}

}  // namespace

Interval exp(const Interval& x) {
    if (!(x.lo <= x.hi) || x.hi > 700) return nothing();
    const double highest = x.hi < -700 ? 1e-300 : exp_of(x.hi).hi;
    return {x.lo < -700 ? 0 : exp_of(x.lo).lo, highest};
}

SineCosine sine_cosine(const Interval& angle) {
    const double radius = angle.radius();
    if (!(angle.size() < 1e5) || !(radius < 1)) return {{-1, 1}, {-1, 1}};
    const SineCosine middle = sine_cosine_of(angle.middle());
    return {widened(middle.sine, radius), widened(middle.cosine, radius)};
}

}  // namespace peterka::certificate
