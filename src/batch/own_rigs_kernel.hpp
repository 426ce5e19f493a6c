// The batched cycle of cells that differ in springs, dampers and stop, and don't share a Rig: each lane has
// these numbers itself, and every contact is followed as one of any length. What rig.hpp finds out about short
// contacts takes as long as some hundred of them.
#pragma once

#include "batch/lanes.hpp"

namespace peterka::batch {

// As run_cycle (cycle_kernel.hpp), but that Jacobians are always there.
void run_own_rigs_cycle(const Grid& grid, const Lanes& lanes, Queues& queues, Wanted wanted);
// The same with cubic springs.
void run_own_rigs_split_cycle(const Grid& grid, const Lanes& lanes, Queues& queues, Wanted wanted);

}  // namespace peterka::batch
