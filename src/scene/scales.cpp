#include "scene/scales.hpp"

#include <variant>

#include "job/derived.hpp"

namespace peterka::scene {

Scales scales_of(const job::Job& job) {
    return {.length_m = job.cart.amplitude_m,
            .frequency_rad_per_s = derive(job.hammer).omega_rad_per_s,
            .force_n = job.hammer.stiffness() * job.cart.amplitude_m,
            .weight_n = job.hammer.mass_kg * standard_gravity};
}

namespace {

ContactLaw<double> stop_of(const job::Job& job) {
    if (const auto* stop = std::get_if<job::KelvinVoigt>(&job.contact)) {
        const auto numbers = derive(*stop, job.hammer);
        return KelvinVoigt<double>{numbers.kappa, numbers.chi};
    }
    if (const auto* stop = std::get_if<job::HuntCrossley>(&job.contact)) {
        const auto numbers = derive(*stop, job.hammer, job.cart);
        return HuntCrossley<double>{numbers.stiffness, stop->exponent, numbers.dissipation};
    }
    return Restitution<double>{std::get<job::Restitution>(job.contact).coefficient};
}

}  // namespace

Oscillator<double> oscillator_of(const job::Job& job) {
    const double amplitude = job.cart.amplitude_m;
    return {.damping_ratio = derive(job.hammer).zeta,
            .contact = stop_of(job),
            .cubic = job.hammer.cubic_stiffness_n_per_m3 * amplitude * amplitude / job.hammer.stiffness(),
            .cubic_form = job.hammer.cubic};
}

}  // namespace peterka::scene
