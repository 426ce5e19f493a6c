// Enclosures of exp, sin, cos and pi, whose bounds are proved from interval operations alone: no function of
// the mathematical library is trusted.
//
// The argument is reduced by multiples of ln 2 or pi/2 as by Cody and Waite (1980), split so that the products
// with the leading parts are exact; the Taylor polynomial of the reduced argument is evaluated in intervals,
// and its remainder in Lagrange's form is added.
#pragma once

#include "certificate/interval.hpp"

namespace peterka::certificate {

inline constexpr Interval pi{0x1.921fb54442d18p+1, 0x1.921fb54442d19p+1};

template <class Number>
struct Constants;
template <>
struct Constants<Interval> {
    static Interval pi() { return certificate::pi; }
};

template <class Number>
struct SineCosineOf {
    Number sine;
    Number cosine;
};
using SineCosine = SineCosineOf<Interval>;

// nothing() above 700; 0 ... 1e-300 below -700.
[[nodiscard]] Interval exp(const Interval& x);

// -1 ... 1 for angles beyond 1e5 or wider than 2.
[[nodiscard]] SineCosine sine_cosine(const Interval& angle);

// The same templates also serve searches in doubles, which prove nothing.
inline SineCosineOf<double> sine_cosine(double angle) {
    return {std::sin(angle), std::cos(angle)};
}

}  // namespace peterka::certificate
