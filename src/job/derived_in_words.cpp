#include "job/derived_in_words.hpp"

#include <fmt/format.h>

#include <numbers>
#include <variant>

#include "job/derived.hpp"

namespace peterka::job {

namespace {

std::string in_words(const KelvinVoigt& stop, const Job& job) {
    const KelvinVoigtNumbers numbers = derive(stop, job.hammer);
    return fmt::format("kappa = ki/k = {:.6g}, chi = ci/(m omega) = {:.6g}", numbers.kappa, numbers.chi);
}

// For a law whose numbers have no names of their own.
template <class Law>
std::string in_words(const Law& /*stop*/, const Job& /*job*/) {
    return Law::is_rigid ? "the stop is rigid" : fmt::format("the stop is \"{}\"", Law::name);
}

std::string in_words(const HuntCrossley& stop, const Job& job) {
    const HuntCrossleyNumbers numbers = derive(stop, job.hammer, job.cart);
    return fmt::format("K A0^(n-1)/k = {:.6g}, D A0 omega = {:.6g}", numbers.stiffness, numbers.dissipation);
}

}  // namespace

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
