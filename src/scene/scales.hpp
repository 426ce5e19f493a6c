// The units of the core, for conversion back to SI.
#pragma once

#include "cell/quantities.hpp"
#include "job/cell_numbers.hpp"
#include "job/job.hpp"
#include "scene/oscillator.hpp"

namespace peterka::scene {

inline constexpr double standard_gravity = 9.80665;  // [m/s^2]

struct Scales {
    double length_m = 1;             // A0
    double frequency_rad_per_s = 1;  // omega = sqrt(k/m)
    double force_n = 1;              // k A0
    double weight_n = 1;             // m g0

    [[nodiscard]] double force_ratio() const { return force_n / weight_n; }  // F/(m g0) of a force k A0

    // A nondimensional number in the unit of the file (cell/quantities.hpp).
    [[nodiscard]] double in_unit_of_file(double number, cell::Dimension dimension) const;
};

Scales scales_of(const job::CellNumbers& numbers);
Scales scales_of(const job::Job& job);  // from the job's tables

// zeta, kappa and chi of a hammer and its stop; frequency and gap are set for each cell.
Oscillator<double> oscillator_of(const job::CellNumbers& numbers);
Oscillator<double> oscillator_of(const job::Job& job);

}  // namespace peterka::scene
