// One cell of a map or a basin: a pure function of the scene and the cell's place.
#pragma once

#include <cstdint>

#include "regime/cell_result.hpp"
#include "scene/scene.hpp"

namespace peterka::regime {

CellResult solve_cell(const scene::Scene& scene, std::int64_t row, std::int64_t column);

}  // namespace peterka::regime
