#include "job/job.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <numbers>

namespace peterka::job {

ContactLaw law_of(const Contact& contact) {
    return std::visit([](const auto& stop) { return stop.law; }, contact);
}

bool is_rigid(const Contact& contact) {
    return std::visit([](const auto& stop) { return stop.is_rigid; }, contact);
}

bool has_closed_form(const Contact& contact) {
    return std::visit([](const auto& stop) { return stop.has_closed_form; }, contact);
}
bool is_dashpot_alone(const Contact& contact) {
    return std::visit([](const auto& stop) { return stop.is_dashpot_alone(); }, contact);
}

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
    return std::max<std::int64_t>(std::ssize(gaps()), 1) * (direction == Direction::both ? 2 : 1);
}

Branch Sweep::branch(std::int64_t i) const {
    const bool both = direction == Direction::both;
    const auto gap = static_cast<std::size_t>(both ? i / 2 : i);
    return {gaps().empty() ? std::nullopt : std::optional(gaps().at(gap)),
            both ? (i % 2 == 0 ? Direction::up : Direction::down) : direction};
}

bool Output::has(OptionalField field) const {
    return std::find(fields.begin(), fields.end(), field) != fields.end();
}

}  // namespace peterka::job
