#include "job/derived.hpp"

#include <cmath>
#include <numbers>

namespace peterka::job {

namespace {

double impedance(const Hammer& hammer) {  // m omega [Ns/m]
    return std::sqrt(hammer.stiffness() * hammer.mass_kg);
}

}  // namespace

HammerNumbers derive(const Hammer& hammer) {
    return {impedance(hammer) / hammer.mass_kg, hammer.damping() / (2 * impedance(hammer))};
}

double natural_frequency_hz(const Hammer& hammer) {
    return hammer.natural_frequency_hz ? *hammer.natural_frequency_hz
                                       : derive(hammer).omega_rad_per_s / (2 * std::numbers::pi);
}

KelvinVoigtNumbers derive(const KelvinVoigt& stop, const Hammer& hammer) {
    return {stop.stiffness_n_per_m / hammer.stiffness(), stop.damping_ns_per_m / impedance(hammer)};
}

HuntCrossleyNumbers derive(const HuntCrossley& stop, const Hammer& hammer, const Cart& cart) {
    return {stop.stiffness_n_per_m_pow_n * std::pow(cart.amplitude_m, stop.exponent - 1) / hammer.stiffness(),
            stop.dissipation_s_per_m * cart.amplitude_m * derive(hammer).omega_rad_per_s};
}

double cycles_shown(const Job& job) {
    if (job.operating_point.frequency_ratio > 0) return static_cast<double>(job.trace.cycles);
    return job.trace.duration_s * natural_frequency_hz(job.hammer);
}

}  // namespace peterka::job
