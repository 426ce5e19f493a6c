#include "trajectory/contact_rates.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

#include "trajectory/contact_force.hpp"

namespace peterka::trajectory {

namespace {

using scene::HuntCrossley;
using scene::KelvinVoigt;

// Integral of v dv/(1 + D v) from 0 to v: the equivalent of a free hammer's speed in the spring's potential.
double work_left(double v, double dissipation) {
    const double x = dissipation * v;
    if (x < 1e-3) return v * v * (0.5 - x / 3);
    return (v - std::log1p(x) / dissipation) / dissipation;
}

// Any law: from the force at this state. A rigid stop has none.
template <class Law>
LinearizedContact linearized(const Law& law, const scene::State<double>& x) {
    const ContactResponse<double> f = contact_response(law, x);
    return {f.by_velocity / 2, f.by_position};
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

// Any law: the depth at which stop and springs balance the force, by bisection, as forces grow with the depth;
// a rigid stop has no force of its own.
template <class Law>
double depth_under(const Law& law, double force) {
    if constexpr (Law::Given::is_rigid) return force;
    constexpr int halvings = 60;
    double below = 0;
    double above = force;
    for (int n = 0; n < halvings; ++n) {
        const double depth = (below + above) / 2;
        const double taken = depth + contact_response(law, scene::State<double>(depth, 0)).force;
        (taken < force ? below : above) = depth;
    }
    return (below + above) / 2;
}

double depth_under(const HuntCrossley<double>& law, double force) {
    return std::min(force, std::pow(force / law.stiffness, 1 / law.exponent));
}

}  // namespace

LinearizedContact linearized_contact(const scene::Oscillator<double>& oscillator,
                                     const scene::State<double>& x) {
    const LinearizedContact stop =
        std::visit([&](const auto& law) { return linearized(law, x); }, oscillator.contact);
    return {oscillator.damping_ratio + stop.damping, 1 + stop.stiffness};
}

Rates rates_of(const LinearizedContact& contact) {
    const auto& [damping, stiffness] = contact;
    const double discriminant = damping * damping - stiffness;
    if (discriminant <= 0) return {std::sqrt(stiffness), std::sqrt(stiffness)};
    const double fast = damping + std::sqrt(discriminant);
    return {stiffness / fast, fast};
}

double static_depth(const scene::Oscillator<double>& oscillator, double force) {
    return std::visit([&](const auto& law) { return depth_under(law, force); }, oscillator.contact);
}

}  // namespace peterka::trajectory
