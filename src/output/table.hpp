// A dataset with its numbers, for files that are written whole (output/whole_file.hpp).
#pragma once

#include <vector>

#include "output/layout.hpp"

namespace peterka::output {

struct Table {
    DatasetPlan plan;
    std::vector<double> values;  // row by row; each kind of number used fits a double exactly
};

}  // namespace peterka::output
