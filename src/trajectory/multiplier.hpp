// The Floquet multiplier of a periodic orbit that is larger in modulus, from its monodromy matrix.
#pragma once

#include <cmath>

namespace peterka::trajectory {

// With the sign of its real part; of a complex pair, whose moduli are equal, the modulus with that sign.
inline double largest_multiplier(double half_trace, double determinant) {
    const double discriminant = half_trace * half_trace - determinant;
    const double modulus =
        discriminant < 0 ? std::sqrt(determinant) : std::abs(half_trace) + std::sqrt(discriminant);
    return std::copysign(modulus, half_trace);
}

}  // namespace peterka::trajectory
