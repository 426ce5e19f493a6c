// What a cell has to be searched for next: several searches that may run side by side, and where their results
// go.
#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "regime/attractor_table.hpp"
#include "regime/cell_result.hpp"
#include "regime/cycle_broker.hpp"
#include "support/task.hpp"

namespace peterka::attractors {

// Begins a search whose cycles others serve at the broker; what it ends on goes to `found`.
using SearchFactory = std::function<Task<regime::CellResult>(regime::CycleBroker& broker,
                                                             std::vector<regime::FoundAttractor>* found)>;

struct SearchOutcome {
    regime::CellResult result;
    std::vector<regime::FoundAttractor> found;
};

}  // namespace peterka::attractors
