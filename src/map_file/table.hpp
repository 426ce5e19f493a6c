// A dataset with its numbers, for files that are written whole (map_file/whole_file.hpp).
#pragma once

#include <vector>

#include "map_file/layout.hpp"

namespace peterka::map_file {

struct Table {
    DatasetPlan plan;
    std::vector<double> values;  // row by row; each kind of number used fits a double exactly
};

}  // namespace peterka::map_file
