// The quantities shown at an instant of the motion, from the engine's state by the equation of motion.
//
//     x'' = -2 zeta u' - u - r - f,   x = u + y,   y = sin(eta tau):   see scene/oscillator.hpp.
// Lengths in A0, times in 1/omega, forces in k A0.
#pragma once

#include "trace/watcher.hpp"

namespace peterka::trace {

struct Instant {
    double time = 0;   // tau since the trace began
    double angle = 0;  // of the forcing
    State<double> state = State<double>::Zero();
    Phase phase = Phase::flight;
};

struct Quantities {
    double cart = 0;  // y
    double cart_velocity = 0;
    double relative = 0;  // u = x - y
    double relative_velocity = 0;
    double acceleration = 0;  // of the hammer, x''
    double force = 0;         // of the stop, on the hammer

    [[nodiscard]] double hammer() const { return relative + cart; }
    [[nodiscard]] double hammer_velocity() const { return relative_velocity + cart_velocity; }
};

[[nodiscard]] Quantities quantities(const scene::Oscillator<double>& oscillator, const Instant& instant);

// Time derivative of the force, while the stop presses and is not rigid.
[[nodiscard]] double force_slope(const scene::Oscillator<double>& oscillator, const Instant& instant);

}  // namespace peterka::trace
