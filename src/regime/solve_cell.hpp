// One cell of a map or a basin: a pure function of the scene and the cell's place.
#pragma once

#include <cstdint>

#include "regime/cell_result.hpp"
#include "scene/scene.hpp"
#include "trajectory/recorder.hpp"

namespace peterka::regime {

// detail: how much of the impacts is measured.
CellResult solve_cell(const scene::Scene& scene, std::int64_t row, std::int64_t column,
                      trajectory::Detail detail = trajectory::Detail::force);

}  // namespace peterka::regime
