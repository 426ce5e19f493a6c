// Amplitude spectra of force and hammer acceleration.
//
// Of the motion: amplitudes of the Fourier series over its length T, 2/T |integral of s exp(-i w t) dt| at
// w = n 2 pi/T and half of that at n = 0: rectangular window, no zero padding. For an orbit T is exactly one of
// its periods, so that its lines are its own; for any other motion T is the whole trace, whose ends don't meet.
// Of one impact: |integral of f exp(-i w t) dt|, its impulse at w = 0; and the same integral of x'' over the
// flight that follows, times 2/T of its length, so that a steady oscillation shows its amplitude. A cart at
// rest leaves one mode oscillating in flight; structural modes as measured in the paper are not in the model.
#pragma once

#include <cstdint>
#include <vector>

#include "trace/course.hpp"
#include "trace/impacts.hpp"

namespace peterka::trace {

inline constexpr std::int64_t most_lines = 8000;

struct Spectrum {
    double step = 0;  // of w, in omega
    std::vector<double> force;
    std::vector<double> acceleration;

    [[nodiscard]] std::int64_t lines() const { return std::ssize(force); }
};

// largest_frequency: of w, in omega; lower if it would take more than most_lines.
[[nodiscard]] Spectrum spectrum_of_motion(const Course& course, double largest_frequency);

// `lines` values of w from 0 to largest_frequency. The flight lasts until next_touch, or ten thousand turns of
// largest_frequency, far longer than the lines resolve.
[[nodiscard]] Spectrum spectrum_of_impact(const Course& course, const Impact& impact, double next_touch,
                                          double largest_frequency, std::int64_t lines);

}  // namespace peterka::trace
