// The attractors of each cell of a map with [starts], and the outcomes of one with [uncertainty], as stored in
// the file: the first slot of all cells, then the second, ..., so that each field has the dimensions
// [attractor][gap_ratio][frequency_ratio].
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "attractors/solved_cell.hpp"
#include "quantities/fields.hpp"
#include "scene/scales.hpp"

namespace peterka::map_file {

// `kept` slots are stored per cell; empty ones have fill values. `scales` has those of each cell.
[[nodiscard]] std::vector<quantities::StoredAttractor> stored_attractors(
    std::span<const attractors::SolvedCell> cells, std::int64_t kept, std::span<const scene::Scales> scales);

// The same of outcomes, of which cell::kept_outcomes are stored per cell.
[[nodiscard]] std::vector<quantities::StoredOutcome> stored_outcomes(
    std::span<const attractors::SolvedCell> cells, std::span<const scene::Scales> scales);

}  // namespace peterka::map_file
