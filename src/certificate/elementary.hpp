// Enclosures of exp, sin, cos and pi, whose bounds are proved from the operations of intervals alone: nothing
// of the mathematical library is trusted.
//
// The argument is reduced by Cody and Waite's multiples of ln 2 or pi/2, split so that the products with the
// leading parts are exact; Taylor's polynomial of the rest is evaluated in intervals, and the remainder by
// Lagrange's form is added.
#pragma once

#include "certificate/interval.hpp"

namespace peterka::certificate {

inline constexpr Interval pi{0x1.921fb54442d18p+1, 0x1.921fb54442d19p+1};

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

// What is only looked for in doubles, and proves nothing, is written by the same templates.
inline SineCosineOf<double> sine_cosine(double angle) {
    return {std::sin(angle), std::cos(angle)};
}

}  // namespace peterka::certificate
