#include "job/job.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
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

std::int64_t Sweep::branches() const {
    return std::ssize(gap_ratio) * (direction == Direction::both ? 2 : 1);
}

Branch Sweep::branch(std::int64_t i) const {
    if (direction != Direction::both) return {gap_ratio[static_cast<std::size_t>(i)], direction};
    return {gap_ratio[static_cast<std::size_t>(i / 2)], i % 2 == 0 ? Direction::up : Direction::down};
}

bool Output::has(OptionalField field) const {
    return std::find(fields.begin(), fields.end(), field) != fields.end();
}

}  // namespace peterka::job
