// The nondimensional numbers of a rig: the one place where they follow from SI units.
//
// omega = sqrt(k/m), zeta = c/(2 m omega), kappa = ki/k, chi = ci/(m omega).
#pragma once

#include <cmath>
#include <numbers>
#include <string>

#include <fmt/format.h>

#include "job/job.hpp"

namespace peterka::job {

struct DerivedNumbers {
    double omega_rad_per_s = 0;
    double zeta = 0;
    double kappa = 0;
    double chi = 0;
};

[[nodiscard]] inline DerivedNumbers derive(const Hammer& hammer, const Contact& contact) {
    const double stiffness = hammer.stiffness();
    const double impedance = std::sqrt(stiffness * hammer.mass_kg);  // m omega [Ns/m]
    return {impedance / hammer.mass_kg, hammer.damping() / (2 * impedance),
            contact.stiffness_n_per_m / stiffness, contact.damping_ns_per_m / impedance};
}

// The same as comment lines, for people who read a resolved job.
[[nodiscard]] inline std::string derived_numbers_in_words(const Job& job) {
    const DerivedNumbers numbers = derive(job.hammer, job.contact);
    return fmt::format(
        "\n# Derived: omega = {:.6g} rad/s ({:.6g} Hz), k = {:.6g} N/m, c = {:.6g} Ns/m,\n"
        "# zeta = c/(2 m omega) = {:.6g}, kappa = ki/k = {:.6g}, chi = ci/(m omega) = {:.6g}\n",
        numbers.omega_rad_per_s, numbers.omega_rad_per_s / (2 * std::numbers::pi), job.hammer.stiffness(),
        job.hammer.damping(), numbers.zeta, numbers.kappa, numbers.chi);
}

}  // namespace peterka::job
