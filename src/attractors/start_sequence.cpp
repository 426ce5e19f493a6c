#include "attractors/start_sequence.hpp"

#include <algorithm>
#include <cmath>

namespace peterka::attractors {

namespace {

// 1/g and 1/g^2 in units of 2^-64, g = 1.3247... the plastic number.
constexpr std::uint64_t step_across = 13925035116211876495U;
constexpr std::uint64_t step_up = 10511698010929265436U;

// The fractional part of 1/2 + n step, in [0, 1).
double fraction(std::int64_t n, std::uint64_t step) {
    constexpr std::uint64_t half = std::uint64_t{1} << 63U;
    const std::uint64_t digits = half + static_cast<std::uint64_t>(n) * step;
    return std::ldexp(static_cast<double>(digits >> 11U), -53);
}

// A side of the rectangle as the job gives it, as ratios or in SI units.
Interval side(const std::vector<double>& ratios, const std::vector<double>& in_si, double unit) {
    if (in_si.empty()) return {ratios.front(), ratios.back()};
    return {in_si.front() / unit, in_si.back() / unit};
}

}  // namespace

Interval displacements_of(const job::Starts& starts, const scene::Scales& scales) {
    return side(starts.displacement_ratio, starts.displacement_m, scales.length_m);
}

Interval velocities_of(const job::Starts& starts, const scene::Scales& scales) {
    return side(starts.velocity_ratio, starts.velocity_m_per_s, scales.length_m * scales.frequency_rad_per_s);
}

scene::State<double> start_of(const job::Starts& starts, const scene::Cell& cell, std::int64_t n) {
    const scene::Oscillator<double>& oscillator = cell.oscillator;
    const Interval across = displacements_of(starts, cell.scales);
    const Interval up = velocities_of(starts, cell.scales);
    const double right = std::min(across.to, oscillator.gap);
    const double displacement = across.from + (right - across.from) * fraction(n, step_across);
    const double velocity = up.from + (up.to - up.from) * fraction(n, step_up);
    // at phase 0 the cart passes its middle at full speed
    return {std::min(displacement - oscillator.gap, 0.0), velocity - oscillator.frequency};
}

}  // namespace peterka::attractors
