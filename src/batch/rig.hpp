// The rig shared by all lanes of a batch: the springs' damping and the stop, and constants derived from them.
//
// Most contacts are short compared with the forcing: the hammer meets the stop with a speed v, and the
// acceleration eta^2 sin(theta) - gap by cart and springs changes little, from a by at most J t. Let f be the
// unforced force after a unit speed, which is also the response to a unit step of the acceleration. Then
//     F' = v f' + a f + R',   F'' = v f'' + a f' + R'',
//     |R'| <= J t (chi + I1),   |R''| <= J (chi + |f'(0)| t + I2 t),   I1 = integral |f'|,  I2 = integral
//     |f''|.
// Where these bounds and a range of a/v show that F rises or is concave up to `falls_from`, and falls from
// there to `latest_exit`, it has one maximum and one zero up to then, and Newton's method finds them, starting
// from those of f.
#pragma once

#include <array>
#include <cstddef>

#include "scene/oscillator.hpp"

namespace peterka::batch {

// (x, x') after a time, from (1, 0) and (0, 1), in a linear phase.
struct Flow {
    double e00 = 1;  // x  from x = 1
    double e01 = 0;  // x  from x' = 1
    double e10 = 0;  // x' from x = 1
    double e11 = 1;  // x' from x' = 1
};

struct Rig {
    explicit Rig(const scene::Oscillator<double>& oscillator);

    bool rigid = false;            // the stop; its only parameter then follows
    double restitution = 0;        // r
    double damping_ratio = 0;      // zeta
    bool weakly_damped = false;    // a flight of six steps decays by less than a tenth
    double flight_rate = 0;        // damped frequency of the flight
    double cubic = 0;              // coefficient of u^3
    double stiffness = 0;          // kappa
    double damping = 0;            // chi
    double lag = 0;                // chi/kappa: the force vanishes where delta = -lag delta'
    double contact_decay = 0;      // b = zeta + chi/2
    double contact_square = 0;     // w2 = 1 + kappa
    double contact_frequency = 0;  // its root
    double contact_rate = 0;       // damped frequency of the contact

    // Whether the flight and, if the stop is compliant, the contact oscillate clearly enough for closed forms
    // without cancellation.
    bool fit = false;

    // An unforced contact, and when a forced one surely has the same shape.
    double exit_time = 0;  // the force falls through zero
    Flow exit_flow;
    double peak_time = 0;  // the force is largest
    Flow peak_flow;
    double falls_from = 0;   // the force falls from here ...
    double latest_exit = 0;  // ... up to here
    // where a/v and J/v are in these ranges; empty if the unforced force does not have this shape
    double least_pull = 1;
    double largest_pull = 0;
    double largest_jerk = 0;

    // Guesses of both times for a constant a, as polynomials in a/(v pull_scale) between -1 and 1: they save
    // one Newton step.
    static constexpr std::size_t guess_terms = 10;
    double pull_scale = 1;
    std::array<double, guess_terms> exit_shift{};  // from exit_time
    std::array<double, guess_terms> peak_shift{};

    // (x, x') a short time t after (0, 1) in contact: the series sum of c_n t^n, and that of its derivative.
    static constexpr std::size_t series_length = 18;
    std::array<double, series_length> series{};
    std::array<double, series_length> slope_series{};
};

}  // namespace peterka::batch
