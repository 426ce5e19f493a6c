// The batched cycle with a cubic spring: run_cycle (cycle_kernel.hpp) passes it on.
#pragma once

#include "batch/lanes.hpp"
#include "batch/rig.hpp"

namespace peterka::batch {

void run_split_cycle(const Rig& rig, const Grid& grid, const Lanes& lanes, Queues& queues, Wanted wanted);

}  // namespace peterka::batch
