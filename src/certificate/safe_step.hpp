// How long a quantity, known by value, slope and a bound of its second derivative, surely stays at most 0.
#pragma once

#include <algorithm>
#include <cmath>

namespace peterka::certificate {

// Approximately the largest h for which value + slope h + bend h^2/2 <= 0; 0 if there is none. For each sign of
// the slope the form of the root in which nothing cancels.
inline double safe_step(double value, double slope, double bend) {
    if (!(value <= 0)) return 0;
    const double root = std::sqrt(std::max(0.0, slope * slope - 2 * bend * value));
    return slope > 0 ? -2 * value / (slope + root) : (root - slope) / bend;
}

}  // namespace peterka::certificate
