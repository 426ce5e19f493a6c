// The attractors of each cell of a map with [starts], as the file holds them: all of the first slot, cell after
// cell, then those of the second, ... so each field lies on [attractor][gap_ratio][frequency_ratio].
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "attractors/solved_cell.hpp"
#include "quantities/fields.hpp"
#include "scene/scales.hpp"

namespace peterka::map_file {

// So many of each cell are kept; empty slots have fill values. `scales` has those of each cell.
[[nodiscard]] std::vector<quantities::StoredAttractor> stored_attractors(
    std::span<const attractors::SolvedCell> cells, std::int64_t kept, std::span<const scene::Scales> scales);

}  // namespace peterka::map_file
