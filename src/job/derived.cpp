#include "job/derived.hpp"

#include <cmath>
#include <numbers>
#include <variant>

#include <fmt/format.h>

namespace peterka::job {

namespace {

double impedance(const Hammer& hammer) {  // m omega [Ns/m]
    return std::sqrt(hammer.stiffness() * hammer.mass_kg);
}

std::string in_words(const KelvinVoigt& stop, const Job& job) {
    const KelvinVoigtNumbers numbers = derive(stop, job.hammer);
    return fmt::format("kappa = ki/k = {:.6g}, chi = ci/(m omega) = {:.6g}", numbers.kappa, numbers.chi);
}

std::string in_words(const Restitution&, const Job&) {
    return "the stop is rigid";
}

std::string in_words(const HuntCrossley& stop, const Job& job) {
    const HuntCrossleyNumbers numbers = derive(stop, job.hammer, job.cart);
    return fmt::format("K A0^(n-1)/k = {:.6g}, D A0 omega = {:.6g}", numbers.stiffness, numbers.dissipation);
}

}  // namespace

HammerNumbers derive(const Hammer& hammer) {
    return {impedance(hammer) / hammer.mass_kg, hammer.damping() / (2 * impedance(hammer))};
}

KelvinVoigtNumbers derive(const KelvinVoigt& stop, const Hammer& hammer) {
    return {stop.stiffness_n_per_m / hammer.stiffness(), stop.damping_ns_per_m / impedance(hammer)};
}

HuntCrossleyNumbers derive(const HuntCrossley& stop, const Hammer& hammer, const Cart& cart) {
    return {stop.stiffness_n_per_m_pow_n * std::pow(cart.amplitude_m, stop.exponent - 1) / hammer.stiffness(),
            stop.dissipation_s_per_m * cart.amplitude_m * derive(hammer).omega_rad_per_s};
}

std::string derived_numbers_in_words(const Job& job) {
    const HammerNumbers hammer = derive(job.hammer);
    return fmt::format(
        "\n# Derived: omega = {:.6g} rad/s ({:.6g} Hz), k = {:.6g} N/m, c = {:.6g} Ns/m,\n"
        "# zeta = c/(2 m omega) = {:.6g}, {}\n",
        hammer.omega_rad_per_s, hammer.omega_rad_per_s / (2 * std::numbers::pi), job.hammer.stiffness(),
        job.hammer.damping(), hammer.zeta,
        std::visit([&](const auto& stop) { return in_words(stop, job); }, job.contact));
}

}  // namespace peterka::job
