// The attractors with which a cell is filled that lies between cells with several starts, and the outcomes of
// one between cells with uncertain rigs.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "attractors/solved_cell.hpp"
#include "refine/fill.hpp"

namespace peterka::refine {

// Nothing if the cells around do not have the same attractors, distinguished by their labels, or a force or
// share is not smooth. starts: of each cell.
[[nodiscard]] std::optional<std::vector<attractors::CellAttractor>> filled_attractors(
    const Surroundings& around, std::int64_t starts);

// The same of outcomes. rigs: drawn for each cell.
[[nodiscard]] std::optional<std::vector<attractors::CellOutcome>> filled_outcomes(const Surroundings& around,
                                                                                  std::int64_t rigs);

}  // namespace peterka::refine
