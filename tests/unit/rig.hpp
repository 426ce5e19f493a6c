// The paper's hammer (Tables 2 and 3 of Aguiar & Weber) and small helpers that tests of the physics share.
#pragma once

#include <cmath>
#include <numbers>

#include "job/job.hpp"
#include "regime/steady_state.hpp"
#include "scene/oscillator.hpp"

namespace peterka::testing {

struct BeamSpring {
    double natural_frequency_hz;
    double damping_ns_per_m;
};
inline constexpr BeamSpring beam_170mm{4.50, 0.06};
inline constexpr BeamSpring beam_150mm{5.25, 0.08};
inline constexpr double paper_cubic = 0.89e-3 * 0.89e-3;  // A0^2 k3/k for k3 = k * 1 m^-2

inline scene::Oscillator<double> paper_rig(BeamSpring beam, double frequency_ratio, double gap_ratio) {
    const double mass = 0.298;
    const double omega = 2 * std::numbers::pi * beam.natural_frequency_hz;
    return {.damping_ratio = beam.damping_ns_per_m / (2 * mass * omega),
            .contact = scene::KelvinVoigt<double>{5.5e6 / (mass * omega * omega), 1.2e3 / (mass * omega)},
            .frequency = frequency_ratio,
            .gap = gap_ratio};
}

// The same hammer, 170 mm springs, as a job without axes. The paper's cubic stiffness is 238.2325 N/m^3.
inline job::Job job_170mm(double cubic_stiffness_n_per_m3) {
    job::Job job;
    job.hammer.mass_kg = 0.298;
    job.hammer.natural_frequency_hz = beam_170mm.natural_frequency_hz;
    job.hammer.damping_ns_per_m = beam_170mm.damping_ns_per_m;
    job.hammer.cubic_stiffness_n_per_m3 = cubic_stiffness_n_per_m3;
    job.cart.amplitude_m = 0.89e-3;
    job.contact = job::KelvinVoigt{5.5e6, 1.2e3};
    return job;
}

// Relative state at phase 0 of a hammer that starts at x/A0, x'/(A0 omega).
inline scene::State<double> start_at(const scene::Oscillator<double>& oscillator, double displacement = 0,
                                     double velocity = 0) {
    return {displacement - oscillator.gap, velocity - oscillator.frequency};
}

inline regime::CellResult solve(const scene::Oscillator<double>& oscillator, double displacement = 0,
                                double velocity = 0, const job::SteadyState& budget = {}) {
    return regime::find_steady_state(oscillator, start_at(oscillator, displacement, velocity), budget);
}

// Amplitude of the steady motion without a stop: the edge of no impact is gap = this.
inline double free_amplitude(const scene::Oscillator<double>& oscillator) {
    const double eta = oscillator.frequency;
    return eta * eta / std::hypot(1 - eta * eta, 2 * oscillator.damping_ratio * eta);
}

}  // namespace peterka::testing
