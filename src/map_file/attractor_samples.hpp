// Samples of the motions on all attractors at each point of a sweep with [starts], for complete bifurcation
// diagrams: like those of its branches (samples.hpp), each with its attractor.
//
// All attractors of a point share its room for `samples` samples of a kind: in order of decreasing share, each
// takes at most an equal part of what is left.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "attractors/along_branch.hpp"
#include "hdf5/variable.hpp"
#include "regime/cell_result.hpp"

namespace peterka::map_file {

// clang-format off
inline constexpr std::array<hdf5::Variable, 6> attractor_sample_variables{
    hdf5::Variable{"stroboscopic_attractor", hdf5::Number::int32, -1, "1", "attractor of the point that the sample of a motion at forcing phase 0 is of; -1 for none"},
    hdf5::Variable{"attractor_stroboscopic_displacement", hdf5::Number::float64, regime::unknown, "1", "hammer displacement at forcing phase 0 on that attractor, x/A0 = (x - y)/A0"},
    hdf5::Variable{"attractor_stroboscopic_velocity", hdf5::Number::float64, regime::unknown, "1", "hammer velocity relative to the cart at forcing phase 0 on that attractor, (x' - y')/(A0 omega)"},
    hdf5::Variable{"impact_attractor", hdf5::Number::int32, -1, "1", "attractor of the point that the sample of an impact is of; -1 for none"},
    hdf5::Variable{"attractor_impact_displacement", hdf5::Number::float64, regime::unknown, "1", "hammer displacement at first touch on that attractor, not relative to the cart: x/A0"},
    hdf5::Variable{"attractor_impact_velocity", hdf5::Number::float64, regime::unknown, "1", "hammer velocity relative to the cart at first touch on that attractor, (x' - y')/(A0 omega)"},
};
// clang-format on

// Variable after variable, each [row][point][sample]; all `rows` rows are identical.
[[nodiscard]] std::vector<std::byte> attractor_sample_bytes(std::span<const attractors::PointAttractors> points,
                                                            std::int64_t rows, std::int64_t samples);

}  // namespace peterka::map_file
