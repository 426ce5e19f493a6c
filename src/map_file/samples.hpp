// Samples of the steady motion at each point of a sweep, for bifurcation diagrams: where the hammer is at
// forcing phase 0, and where an impact begins.
//
// At phase 0 the cart passes its middle position, so that x = x - y. At first touch x - y is the gap and
// carries no information, whereas x gives the position of the cart.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "hdf5/variable.hpp"
#include "job/job.hpp"
#include "regime/branch.hpp"

namespace peterka::map_file {

// clang-format off
inline constexpr std::array<hdf5::Variable, 4> sample_variables{
    hdf5::Variable{"stroboscopic_displacement", hdf5::Number::float64, regime::unknown, "1", "hammer displacement at forcing phase 0, where the cart passes its middle: x/A0 = (x - y)/A0; NaN beyond the motion's own samples"},
    hdf5::Variable{"stroboscopic_velocity", hdf5::Number::float64, regime::unknown, "1", "hammer velocity relative to the cart at forcing phase 0, (x' - y')/(A0 omega); NaN beyond the motion's own samples"},
    hdf5::Variable{"impact_displacement", hdf5::Number::float64, regime::unknown, "1", "hammer displacement at first touch, not relative to the cart: x/A0, where (x - y)/A0 is the gap; NaN beyond the motion's own impacts"},
    hdf5::Variable{"impact_velocity", hdf5::Number::float64, regime::unknown, "1", "hammer velocity relative to the cart at first touch, (x' - y')/(A0 omega); NaN beyond the motion's own impacts"},
};
// clang-format on

// Those of a job, with those of its attractors (attractor_samples.hpp) if it has [starts].
[[nodiscard]] std::vector<hdf5::Variable> stored_sample_variables(const job::Job& job);

// Variable after variable, each [point][sample], `samples` of them per point.
[[nodiscard]] std::vector<double> sample_values(std::span<const regime::BranchPoint> points,
                                                std::int64_t samples);

}  // namespace peterka::map_file
