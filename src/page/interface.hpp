// The engine as called by a web page: plain functions and arrays of numbers.
//
// A caller writes the numbers of a cell into peterka_cell(), in the order of CellNumber, begins, and advances
// until the cell is solved; then peterka_answer() holds the numbers of AnswerNumber. JavaScript that relies on
// these orders: postprocess/peterka/page/engine.js.
#pragma once

#include <cstdint>

namespace peterka::page {

// As in the job file; NaN for what is not given. The stop's three numbers, law by law: stiffness, damping
// (Kelvin-Voigt); coefficient (restitution); K, n, D (Hunt-Crossley).
enum CellNumber : std::uint8_t {
    mass_kg,
    natural_frequency_hz,
    stiffness_n_per_m,
    damping_ns_per_m,
    damping_ratio,
    cubic_stiffness_n_per_m3,
    cubic_form,  // as job::CubicForm
    amplitude_m,
    contact_law,  // place in job::Contact
    contact_first,
    contact_second,
    contact_third,
    max_cycles,
    max_period,
    chaos_cycles,
    engine_choice,  // as job::EngineChoice
    tolerance,
    omit_tolerance,
    frequency_ratio,
    gap_ratio,
    displacement_ratio,
    velocity_ratio,
    cell_numbers
};

// In the units of a map's file.
enum AnswerNumber : std::uint8_t {
    regime_of_cell,
    status_of_cell,
    engine_of_cell,
    impacts,
    period,
    cycles,
    peak_force_ratio,
    impact_rate,
    chatter,
    lyapunov,
    sensitivity,
    impact_speed,
    impulse,
    contact_time,
    contact_power_w,
    max_displacement,
    orbit_displacement,  // of the steady motion where it can be followed from, (x - y)/A0 and its rate
    orbit_velocity,
    length_m,  // the scales: A0, omega, k A0, m g0
    frequency_rad_per_s,
    force_n,
    weight_n,
    answer_numbers
};

}  // namespace peterka::page

extern "C" {

double* peterka_cell();

// measures: 0 for what every map stores; 1 also for impact speed and similar, and the stroboscopic points.
void peterka_begin(int measures);
// Returns 1 once the cell is solved.
int peterka_advance(int cycles);
const double* peterka_answer();

// Stroboscopic points of the steady motion, as pairs (x - y, its rate) in A0 and A0 omega.
int peterka_count_points();
const double* peterka_points();

// Follows the motion of a solved cell from its start (steady: 0) or in its steady state (1); returns the cycles
// followed. Its results:
int peterka_follow(int steady, int cycles, int samples_per_cycle);
// - samples of five numbers: tau, cart y, x - y, its rate, force, in A0, A0 omega and k A0
int peterka_count_samples();
const double* peterka_samples();
// - impacts of five numbers: tau of first touch and of the end, speed, peak force, time pressed
int peterka_count_impacts();
const double* peterka_impacts();
// - the points at the end of each cycle replace those of the steady motion
// - eigenvalues of the cycles' Jacobian (Floquet multipliers of an orbit): real and imaginary part of both
const double* peterka_multipliers();

// Replaces the samples by those of one impact at close range.
void peterka_look_closely(int impact, int count);
}
