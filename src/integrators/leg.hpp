// One leg of a cycle as SUNDIALS sees it: right-hand side, its analytic Jacobian, and error weights.
//
// Six unknowns: the state (delta, delta') and, column by column, its derivatives by the state at the start of
// the leg (the variational equations). Time is local, from 0 at the start of the leg; the forcing phase at that
// start is stored separately, so that no digits are lost late in a run.
#pragma once

#include <nvector/nvector_serial.h>
#include <sundials/sundials_matrix.h>

#include "trajectory/equation_of_motion.hpp"

namespace peterka::integrators {

using scene::Jacobian;
using scene::Oscillator;
using scene::State;
using trajectory::Acceleration;
using trajectory::Phase;

// A point of a leg.
struct LegPoint {
    double time = 0;  // from the start of the leg, in 1/omega
    State<double> state = State<double>::Zero();
    Jacobian<double> flow = Jacobian<double>::Identity();  // of the state by the leg's initial state
};

struct SundialsLeg {
    Oscillator<double> oscillator;
    double local_tolerance = 1e-9;
    Phase phase = Phase::flight;
    double start_angle = 0;  // forcing phase at local time 0
    double hop_speed = 0;    // of a flight that starts with a rebound too slow for the usual scales

    [[nodiscard]] Acceleration<double> acceleration_at(const State<double>& x, double time) const {
        return acceleration(oscillator, phase, x, start_angle + oscillator.frequency * time);
    }
};

constexpr int leg_unknowns = 6;
void store(const LegPoint& point, N_Vector unknowns);
LegPoint load(N_Vector unknowns, double time);

// Callbacks; user data is a SundialsLeg. A non-finite state stops the integration.
int leg_slope(double time, N_Vector unknowns, N_Vector slope, void* leg);
int leg_jacobian(double time, N_Vector unknowns, N_Vector slope, SUNMatrix jacobian, void* leg, N_Vector,
                 N_Vector, N_Vector);
// How often a step may be shortened: the Hunt-Crossley force starts with a kink that hides from the first
// guess.
constexpr int most_retries = 50;
// Errors are relative to the energy of the motion, position and velocity together: a position that passes
// through zero is no more accurate than its neighbours. Each column of the flow is treated in the same way.
int leg_weights(N_Vector unknowns, N_Vector weights, void* leg_data);

}  // namespace peterka::integrators
