#include "trace/spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "trace/transform.hpp"

namespace peterka::trace {

Spectrum spectrum_of_motion(const Course& course, double largest_frequency) {
    Course seen = course;
    if (course.period > 0) seen.length = static_cast<double>(course.period) * course.oscillator.period();
    Spectrum spectrum{.step = 2 * std::numbers::pi / seen.length, .force = {}, .acceleration = {}};
    const double last_line = std::min(largest_frequency / spectrum.step, static_cast<double>(most_lines - 1));
    Transform transform(seen.oscillator, 0, seen.length, spectrum.step,
                        static_cast<std::int64_t>(last_line) + 1);
    follow(seen, transform);
    for (const auto& integrals : transform.lines()) {
        const double share = (spectrum.force.empty() ? 1 : 2) / seen.length;
        spectrum.force.push_back(share * std::abs(integrals.force));
        spectrum.acceleration.push_back(share * std::abs(integrals.acceleration));
    }
    return spectrum;
}

Spectrum spectrum_of_impact(const Course& course, const Impact& impact, double next_touch,
                            double largest_frequency, std::int64_t lines) {
    Spectrum spectrum{
        .step = largest_frequency / static_cast<double>(lines - 1), .force = {}, .acceleration = {}};
    Transform pulse(course.oscillator, impact.time, impact.end, spectrum.step, lines);
    follow(course, pulse);
    const double flight_end = std::min(next_touch, impact.end + 2e4 * std::numbers::pi / largest_frequency);
    Transform flight(course.oscillator, impact.end, flight_end, spectrum.step, lines);
    follow(course, flight);
    const double per_length = 2 / (flight_end - impact.end);
    for (const auto& integrals : pulse.lines()) {
        spectrum.force.push_back(std::abs(integrals.force));
    }
    for (const auto& integrals : flight.lines()) {
        spectrum.acceleration.push_back(per_length * std::abs(integrals.acceleration));
    }
    return spectrum;
}

}  // namespace peterka::trace
