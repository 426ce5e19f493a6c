#include "trajectory/contact_rates.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

namespace peterka::trajectory {

namespace {

using scene::HuntCrossley;
using scene::KelvinVoigt;
using scene::Restitution;

// Integral of v dv/(1 + D v) from 0 to v: what a free hammer's speed is worth in the spring's potential.
double work_left(double v, double dissipation) {
    const double x = dissipation * v;
    if (x < 1e-3) return v * v * (0.5 - x / 3);
    return (v - std::log1p(x) / dissipation) / dissipation;
}

LinearizedContact linearized(const KelvinVoigt<double>& law, const scene::State<double>& /*x*/) {
    return {law.damping / 2, law.stiffness};
}

LinearizedContact linearized(const Restitution<double>& /*law*/, const scene::State<double>& /*x*/) {
    return {0, 0};
}

LinearizedContact linearized(const HuntCrossley<double>& law, const scene::State<double>& x) {
    const double m = law.exponent + 1;
    const double potential =
        std::pow(std::max(x[0], 0.0), m) + m / law.stiffness * work_left(std::abs(x[1]), law.dissipation);
    const double depth = std::pow(potential, 1 / m);
    const double slope = law.stiffness * std::pow(depth, law.exponent - 1);
    return {law.dissipation * slope * depth / 2, law.exponent * slope};
}

double depth_under(const KelvinVoigt<double>& law, double force) {
    return force / (1 + law.stiffness);
}

double depth_under(const Restitution<double>& /*law*/, double force) {
    return force;
}

double depth_under(const HuntCrossley<double>& law, double force) {
    return std::min(force, std::pow(force / law.stiffness, 1 / law.exponent));
}

}  // namespace

LinearizedContact linearized_contact(const scene::Oscillator<double>& scene, const scene::State<double>& x) {
    const LinearizedContact stop =
        std::visit([&](const auto& law) { return linearized(law, x); }, scene.contact);
    return {scene.damping_ratio + stop.damping, 1 + stop.stiffness};
}

Rates rates_of(const LinearizedContact& contact) {
    const auto& [damping, stiffness] = contact;
    const double discriminant = damping * damping - stiffness;
    if (discriminant <= 0) return {std::sqrt(stiffness), std::sqrt(stiffness)};
    const double fast = damping + std::sqrt(discriminant);
    return {stiffness / fast, fast};
}

double static_depth(const scene::Oscillator<double>& scene, double force) {
    return std::visit([&](const auto& law) { return depth_under(law, force); }, scene.contact);
}

}  // namespace peterka::trajectory
