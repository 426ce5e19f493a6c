#include "attractors/start_sequence.hpp"

#include <algorithm>
#include <cmath>

namespace peterka::attractors {

namespace {

// 1/g and 1/g^2 in units of 2^-64, g = 1.3247... the plastic number.
constexpr std::uint64_t step_across = 13925035116211876495U;
constexpr std::uint64_t step_up = 10511698010929265436U;

// The fraction of 1/2 + n step, from 0 up to but not including 1.
double fraction(std::int64_t n, std::uint64_t step) {
    constexpr std::uint64_t half = std::uint64_t{1} << 63U;
    const std::uint64_t digits = half + static_cast<std::uint64_t>(n) * step;
    return std::ldexp(static_cast<double>(digits >> 11U), -53);
}

}  // namespace

scene::State<double> start_of(const job::Starts& starts, const scene::Oscillator<double>& cell,
                              std::int64_t n) {
    const double left = starts.displacement_ratio.front();
    const double right = std::min(starts.displacement_ratio.back(), cell.gap);
    const double lowest = starts.velocity_ratio.front();
    const double highest = starts.velocity_ratio.back();
    const double displacement = left + (right - left) * fraction(n, step_across);
    const double velocity = lowest + (highest - lowest) * fraction(n, step_up);
    // the cart passes its middle at full speed
    return {std::min(displacement - cell.gap, 0.0), velocity - cell.frequency};
}

}  // namespace peterka::attractors
