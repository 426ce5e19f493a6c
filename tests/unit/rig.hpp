// The paper's hammer (Tables 2 and 3 of Aguiar & Weber) and small helpers that tests of the physics share.
#pragma once

#include <cmath>
#include <numbers>

#include "regime/steady_state.hpp"
#include "scene/oscillator.hpp"

namespace peterka::testing {

struct BeamSpring {
    double natural_frequency_hz;
    double damping_ns_per_m;
};
inline constexpr BeamSpring beam_170mm{4.50, 0.06};
inline constexpr BeamSpring beam_150mm{5.25, 0.08};

inline scene::Oscillator<double> paper_rig(BeamSpring beam, double frequency_ratio, double gap_ratio) {
    const double mass = 0.298;
    const double omega = 2 * std::numbers::pi * beam.natural_frequency_hz;
    return {.damping_ratio = beam.damping_ns_per_m / (2 * mass * omega),
            .contact = scene::KelvinVoigt<double>{5.5e6 / (mass * omega * omega), 1.2e3 / (mass * omega)},
            .frequency = frequency_ratio,
            .gap = gap_ratio};
}

// Relative state at phase 0 of a hammer that starts at x/A0, x'/(A0 omega).
inline scene::State<double> start_at(const scene::Oscillator<double>& scene, double displacement = 0,
                                     double velocity = 0) {
    return {displacement - scene.gap, velocity - scene.frequency};
}

inline regime::CellResult solve(const scene::Oscillator<double>& scene, double displacement = 0,
                                double velocity = 0, const regime::Budget& budget = {}) {
    return regime::find_steady_state(scene, start_at(scene, displacement, velocity), budget);
}

// Amplitude of the steady motion without a stop: the edge of no impact is gap = this.
inline double free_amplitude(const scene::Oscillator<double>& scene) {
    const double eta = scene.frequency;
    return eta * eta / std::hypot(1 - eta * eta, 2 * scene.damping_ratio * eta);
}

}  // namespace peterka::testing
