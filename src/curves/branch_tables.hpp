// The datasets of the unstable branches.
#pragma once

#include <vector>

#include "curves/unstable_branch.hpp"
#include "map_file/table.hpp"
#include "scene/scene.hpp"

namespace peterka::curves {

// None without any.
[[nodiscard]] std::vector<map_file::Table> branch_tables(const scene::Scene& scene,
                                                         const std::vector<UnstableBranch>& branches);

}  // namespace peterka::curves
