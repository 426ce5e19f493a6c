// How fast a contact evolves and how deep it gets: the scales relative to which an integrator's errors count.
#pragma once

#include "scene/oscillator.hpp"

namespace peterka::trajectory {

// x'' + 2 damping x' + stiffness x: the contact's motion near a state, without forcing.
struct LinearizedContact {
    double damping = 0;
    double stiffness = 1;
};

// A Hunt-Crossley stop is linearized at the depth reached by a free hammer that passes delta with the speed
// |delta'|: d^(n+1) = delta^(n+1) + (n+1)/K (v/D - ln(1 + D v)/D^2), from v dv/(1 + D v) = -K delta^n d delta.
// So the scales stay constant during a contact, while the force grows from 0.
LinearizedContact linearized_contact(const scene::Oscillator<double>& oscillator,
                                     const scene::State<double>& x);

// The rates of a linear phase without forcing: its slow and its fast decay, or both its natural frequency where
// it oscillates. In omega.
struct Rates {
    double slow = 1;
    double fast = 1;
};
Rates rates_of(const LinearizedContact& contact);

// The off-resonance response to the forcing: the size of a motion, 1 if the cart is at rest. [A0]
inline double response_length(const scene::Oscillator<double>& oscillator) {
    return oscillator.frequency > 0 ? oscillator.drive() / (1 + oscillator.drive()) : 1;
}

// Static penetration of the stop under a force [k A0].
double static_depth(const scene::Oscillator<double>& oscillator, double force);

}  // namespace peterka::trajectory
