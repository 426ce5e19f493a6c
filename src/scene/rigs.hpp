// Which cells of a job share their springs, dampers and stop.
#pragma once

#include "scene/scene.hpp"

namespace peterka::scene {

enum class Rigs {
    one,       // all cells
    of_lines,  // those of a row, or those of a column
    of_cells,  // none
};

[[nodiscard]] Rigs rigs_of(const Scene& scene);

}  // namespace peterka::scene
