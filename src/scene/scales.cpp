#include "scene/scales.hpp"

#include "job/derived.hpp"

namespace peterka::scene {

Scales scales_of(const job::CellNumbers& numbers) {
    return {.length_m = numbers.cart.amplitude_m,
            .frequency_rad_per_s = derive(numbers.hammer).omega_rad_per_s,
            .force_n = numbers.hammer.stiffness() * numbers.cart.amplitude_m,
            .weight_n = numbers.hammer.mass_kg * standard_gravity};
}

Scales scales_of(const job::Job& job) {
    return scales_of(numbers_in(job));
}

double Scales::in_unit_of_file(double number, cell::Dimension dimension) const {
    const double speed = length_m * frequency_rad_per_s;  // A0 omega
    switch (dimension) {
        case cell::Dimension::label:
        case cell::Dimension::number:
        case cell::Dimension::speed_of_file:
            break;
        case cell::Dimension::force_over_weight:
            return number * force_ratio();
        case cell::Dimension::speed:
            return number * speed;
        case cell::Dimension::impulse:
            return number * (force_n / frequency_rad_per_s);
        case cell::Dimension::time:
            return number / frequency_rad_per_s;
        case cell::Dimension::power:
            return number * (force_n * speed);
        case cell::Dimension::length:
            return number * length_m;
    }
    return number;
}

Oscillator<double> oscillator_of(const job::Job& job) {
    return oscillator_of(numbers_in(job));
}

Oscillator<double> oscillator_of(const job::CellNumbers& numbers) {
    const double amplitude = numbers.cart.amplitude_m;
    return {
        .damping_ratio = derive(numbers.hammer).zeta,
        .contact = law_of(numbers.contact, numbers.hammer, numbers.cart),
        .cubic = numbers.hammer.cubic_stiffness_n_per_m3 * amplitude * amplitude / numbers.hammer.stiffness(),
        .cubic_form = numbers.hammer.cubic};
}

}  // namespace peterka::scene
