// The datasets of the unstable branches.
#pragma once

#include <vector>

#include "curves/axes_of_file.hpp"
#include "curves/rig.hpp"
#include "curves/unstable_branch.hpp"
#include "map_file/table.hpp"

namespace peterka::curves {

// Empty if there are no branches.
[[nodiscard]] std::vector<map_file::Table> branch_tables(const Rig& rig, const AxesOfFile& of_file,
                                                         const std::vector<UnstableBranch>& branches);

}  // namespace peterka::curves
