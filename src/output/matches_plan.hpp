// Whether a dataset of an existing file is what the layout says: there, of its type, its size and its chunks.
#pragma once

#include <hdf5.h>

#include "output/checked.hpp"
#include "output/layout.hpp"

namespace peterka::output {

[[nodiscard]] bool matches_plan(const Checked& check, hid_t file, const DatasetPlan& plan);

}  // namespace peterka::output
