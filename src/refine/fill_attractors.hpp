// With which attractors a cell is filled that lies between cells with several starts.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "attractors/solved_cell.hpp"
#include "refine/fill.hpp"

namespace peterka::refine {

// Nothing where those around don't have the same attractors, told apart by their labels, or a force or share
// isn't smooth. starts: of each cell.
[[nodiscard]] std::optional<std::vector<attractors::CellAttractor>> filled_attractors(
    const Surroundings& around, std::int64_t starts);

}  // namespace peterka::refine
