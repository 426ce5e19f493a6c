// The attractors of each cell of a map with [starts], as the file holds them: variable after variable on
// [attractor][gap_ratio][frequency_ratio].
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "attractors/solved_cell.hpp"
#include "hdf5/variable.hpp"
#include "job/job.hpp"
#include "scene/scales.hpp"

namespace peterka::map_file {

// One in file units: forces over the hammer's weight, F/(m g0), kicks in m/s.
using StoredAttractor = attractors::CellAttractor;

[[nodiscard]] std::vector<hdf5::Variable> attractor_variables(const job::Job& job);  // none without [starts]

// So many of each cell are kept; empty ones have fill values. `scales` has those of each cell.
[[nodiscard]] std::vector<StoredAttractor> in_file_units(std::span<const attractors::SolvedCell> cells,
                                                         std::int64_t kept,
                                                         std::span<const scene::Scales> scales);

// attractors: all of the first slot, cell after cell, then those of the second, ...
[[nodiscard]] std::vector<std::byte> encode(std::span<const hdf5::Variable> variables,
                                            std::span<const StoredAttractor> attractors);
[[nodiscard]] std::vector<StoredAttractor> decode(std::span<const hdf5::Variable> variables,
                                                  std::span<const std::byte> bytes, std::size_t count);

}  // namespace peterka::map_file
