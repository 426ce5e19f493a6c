#include "job/job.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace peterka::job {

double Hammer::stiffness() const {
    if (stiffness_n_per_m) return *stiffness_n_per_m;
    const double angular_frequency = 2 * std::numbers::pi * natural_frequency_hz.value();  // [rad/s]
    return mass_kg * angular_frequency * angular_frequency;
}

double Hammer::damping() const {
    if (damping_ns_per_m) return *damping_ns_per_m;
    return 2 * damping_ratio.value() * std::sqrt(stiffness() * mass_kg);
}

bool Output::has(OptionalField field) const {
    return std::find(fields.begin(), fields.end(), field) != fields.end();
}

}  // namespace peterka::job
