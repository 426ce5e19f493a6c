// Intervals of doubles with enclosing operations: for all real numbers in the operands, the result contains the
// exact result.
//
// Each bound is the rounded result moved outward by Algorithm 1 of Rump, Zimmermann, Boldo and Melquiond
// (Computing predecessor and successor in rounding to nearest, BIT 2009): c -+ (phi |c| + eta) with phi = u (1
// + 2 u), u = 2^-53 and eta = 2^-1074 is at or beyond the doubles next to c, and a correctly rounded c is
// nearer to the exact result than these. It requires rounding to nearest and no fused operations
// (-ffp-contract=off).
//
// What cannot be enclosed by two finite doubles becomes nothing(), with both bounds NaN, and so does every
// result computed from it: every predicate on it is false, so that nothing is proved from it.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace peterka::certificate {

inline double down(double rounded) {
    return rounded - (0x1.0000000000001p-53 * std::abs(rounded) + 0x1p-1074);
}
inline double up(double rounded) {
    return rounded + (0x1.0000000000001p-53 * std::abs(rounded) + 0x1p-1074);
}

struct Interval {
    double lo = 0;
    double hi = 0;

    constexpr Interval() = default;
    constexpr Interval(double exact) : lo(exact), hi(exact) {}  // NOLINT: a double is a number
    constexpr Interval(double lowest, double highest) : lo(lowest), hi(highest) {}

    [[nodiscard]] double middle() const { return lo + 0.5 * (hi - lo); }
    [[nodiscard]] double radius() const;  // from middle() to the farther end
    [[nodiscard]] double size() const { return std::max(std::abs(lo), std::abs(hi)); }  // largest |x|
    [[nodiscard]] bool positive() const { return lo > 0; }
    [[nodiscard]] bool negative() const { return hi < 0; }
    [[nodiscard]] bool holds(double x) const { return lo <= x && x <= hi; }
    [[nodiscard]] bool inside(const Interval& other) const { return other.lo < lo && hi < other.hi; }
    [[nodiscard]] bool apart(const Interval& other) const { return hi < other.lo || other.hi < lo; }
};

inline Interval nothing() {
    return {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN()};
}

// From two correctly rounded bounds.
inline Interval outward(double lowest, double highest) {
    const Interval x{down(lowest), up(highest)};
    return x.hi - x.lo < std::numeric_limits<double>::infinity() ? x : nothing();
}

inline double Interval::radius() const {
    return up(std::max(up(hi - middle()), up(middle() - lo)));
}

inline Interval operator-(const Interval& a) {
    return {-a.hi, -a.lo};
}
inline Interval operator+(const Interval& a, const Interval& b) {
    return outward(a.lo + b.lo, a.hi + b.hi);
}
inline Interval operator-(const Interval& a, const Interval& b) {
    return outward(a.lo - b.hi, a.hi - b.lo);
}
inline Interval operator*(const Interval& a, const Interval& b) {
    const double w = a.lo * b.lo;
    const double x = a.lo * b.hi;
    const double y = a.hi * b.lo;
    const double z = a.hi * b.hi;
    return outward(std::min(std::min(w, x), std::min(y, z)), std::max(std::max(w, x), std::max(y, z)));
}
inline Interval operator/(const Interval& a, const Interval& b) {
    if (!b.positive() && !b.negative()) return nothing();
    const double w = a.lo / b.lo;
    const double x = a.lo / b.hi;
    const double y = a.hi / b.lo;
    const double z = a.hi / b.hi;
    return outward(std::min(std::min(w, x), std::min(y, z)), std::max(std::max(w, x), std::max(y, z)));
}
inline Interval& operator+=(Interval& a, const Interval& b) {
    return a = a + b;
}

inline Interval abs(const Interval& a) {
    if (a.lo >= 0) return a;
    if (a.hi <= 0) return -a;
    return a.lo < 0 && a.hi > 0 ? Interval(0, a.size()) : nothing();
}
inline Interval square(const Interval& a) {
    const Interval size = abs(a);
    const Interval x = outward(size.lo * size.lo, size.hi * size.hi);
    return {x.lo > 0 || std::isnan(x.lo) ? x.lo : 0, x.hi};
}
inline Interval sqrt(const Interval& a) {
    if (!(a.lo >= 0)) return nothing();
    const Interval x = outward(std::sqrt(a.lo), std::sqrt(a.hi));
    return {x.lo > 0 || std::isnan(x.lo) ? x.lo : 0, x.hi};
}
inline Interval hull(const Interval& a, const Interval& b) {
    if (std::isnan(a.lo) || std::isnan(b.lo)) return nothing();
    return {std::min(a.lo, b.lo), std::max(a.hi, b.hi)};
}
// middle +- radius
inline Interval around(double middle, double radius) {
    return outward(middle - radius, middle + radius);
}
inline Interval larger(const Interval& a, const Interval& b) {
    if (std::isnan(a.lo) || std::isnan(b.lo)) return nothing();
    return {std::max(a.lo, b.lo), std::max(a.hi, b.hi)};
}

}  // namespace peterka::certificate
