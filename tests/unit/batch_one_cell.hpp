// What the kernel's functions need of a cell, the same in all lanes, by closed forms of its own.
#pragma once

#include "batch/targets.hpp"

#include <cmath>
#include <complex>

#include "batch/flight-inl.hpp"
#include "scene/oscillator.hpp"

namespace peterka::testing {

namespace lanes = batch::HWY_NAMESPACE;

inline double one_of(lanes::V x) {
    return lanes::Numbers<double>(x)[0];
}

struct OneCell {
    OneCell(const scene::Oscillator<double>& oscillator, int steps)
        : rig(oscillator),
          eta(lanes::all(oscillator.frequency)),
          gap(lanes::all(oscillator.gap)),
          step(lanes::all(oscillator.period() / steps)),
          per_step(lanes::all(steps / oscillator.period())),
          drive(lanes::all(oscillator.drive())),
          static_position(lanes::all(-oscillator.gap)) {
        const std::complex<double> impedance(1 - oscillator.drive(),
                                             2 * oscillator.damping_ratio * oscillator.frequency);
        const std::complex<double> response = oscillator.drive() / impedance;
        swing = std::abs(response);
        re = lanes::all(response.real());
        im = lanes::all(response.imag());
        const double own_rate = std::sqrt(1 - oscillator.damping_ratio * oscillator.damping_ratio);
        rate = lanes::all(own_rate);
        inverse_rate = lanes::all(1 / own_rate);
    }

    batch::Rig rig;
    lanes::V eta, gap, step, per_step, drive, static_position;
    lanes::V square = lanes::all(1);
    lanes::V frequency = lanes::all(1);
    lanes::V re{}, im{}, rate{}, inverse_rate{};
    double swing = 0;
};

// A state at a forcing phase.
inline lanes::Moments moments(const scene::State<double>& state, double phase) {
    return {lanes::all(state[0]), lanes::all(state[1]), lanes::all(std::sin(phase)),
            lanes::all(std::cos(phase))};
}

}  // namespace peterka::testing
