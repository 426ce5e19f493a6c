// The low-discrepancy sequence from which uncertain rigs are drawn: Sobol's, with the direction numbers of Joe
// and Kuo, Constructing Sobol sequences with better two-dimensional projections, SIAM J. Sci. Comput. 30
// (2008).
//
// Of its first 2^k points each 2^-k of an axis has one, so that a few dozen draws already tell means, variances
// and tails of each number. Computed in integers, it is the same on any machine.
#pragma once

#include <cstddef>
#include <cstdint>

namespace peterka::job {

inline constexpr std::size_t sobol_dimensions = 12;

// Coordinate `dimension` of point n, in units of 2^-32; n < 2^32.
[[nodiscard]] std::uint32_t sobol(std::uint32_t n, std::size_t dimension);

}  // namespace peterka::job
