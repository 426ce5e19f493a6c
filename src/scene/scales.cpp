#include "scene/scales.hpp"

#include "job/derived.hpp"

namespace peterka::scene {

Scales scales_of(const job::Job& job) {
    return {.length_m = job.cart.amplitude_m,
            .frequency_rad_per_s = derive(job.hammer, job.contact).omega_rad_per_s,
            .force_n = job.hammer.stiffness() * job.cart.amplitude_m,
            .weight_n = job.hammer.mass_kg * standard_gravity};
}

Oscillator<double> oscillator_of(const job::Job& job) {
    const job::DerivedNumbers numbers = derive(job.hammer, job.contact);
    const double amplitude = job.cart.amplitude_m;
    return {.damping_ratio = numbers.zeta,
            .contact = KelvinVoigt<double>{numbers.kappa, numbers.chi},
            .cubic = job.hammer.cubic_stiffness_n_per_m3 * amplitude * amplitude / job.hammer.stiffness(),
            .cubic_form = job.hammer.cubic};
}

}  // namespace peterka::scene
