// The datasets of a file of curves.
#pragma once

#include <vector>

#include "curves/search.hpp"
#include "map_file/table.hpp"
#include "scene/scene.hpp"

namespace peterka::curves {

[[nodiscard]] std::vector<map_file::Table> tables_of(const scene::Scene& scene, const CurveSearchResult& found);

}  // namespace peterka::curves
