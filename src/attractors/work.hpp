// What a cell has to be searched for next: several searches that may run side by side, and where their results
// go.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "regime/attractor_table.hpp"
#include "regime/cell_result.hpp"
#include "regime/cycle_desk.hpp"
#include "support/task.hpp"

namespace peterka::attractors {

// Begins a search whose cycles others serve at the desk; what it ends on goes to `found`.
using Begin = std::function<Task<regime::CellResult>(regime::CycleDesk& desk,
                                                     std::vector<regime::FoundAttractor>* found)>;

struct Ended {
    regime::CellResult result;
    std::vector<regime::FoundAttractor> found;
};

}  // namespace peterka::attractors
