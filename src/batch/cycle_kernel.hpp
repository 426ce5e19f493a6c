// The batched cycle: entry points of the kernel, chosen at run time for the machine's instruction set.
//
// Each carries lanes from forcing phase 0 to forcing phase 0. Lanes that have come to the end of their cycle
// begin another one; whether all come to its end, too, is a part of what is wanted. Lanes in queues.twin were
// left to the scalar engine. Each stands in a file of its own, so that all are built at the same time.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "batch/lanes.hpp"
#include "batch/rig.hpp"

namespace peterka::batch {

// A spring-dashpot stop, linear springs and those with a cubic part; a rigid stop and linear springs.
void run_linear_cycle(const Rig& rig, const Grid& grid, const Lanes& lanes, Queues& queues, Wanted wanted);
void run_split_cycle(const Rig& rig, const Grid& grid, const Lanes& lanes, Queues& queues, Wanted wanted);
void run_rigid_cycle(const Rig& rig, const Grid& grid, const Lanes& lanes, Queues& queues, Wanted wanted);

// The same for cells that differ in springs, dampers and stop, and don't share a Rig: each lane has these
// numbers itself, and every contact is followed as one of any length. What rig.hpp finds out about short
// contacts takes as long as some hundred of them. Jacobians are always there.
void run_own_rigs_cycle(const Grid& grid, const Lanes& lanes, Queues& queues, Wanted wanted);
void run_own_rigs_split_cycle(const Grid& grid, const Lanes& lanes, Queues& queues, Wanted wanted);
void run_own_rigs_rigid_cycle(const Grid& grid, const Lanes& lanes, Queues& queues, Wanted wanted);

// "fma" or "plain": results of machines with the same arithmetic have the same bytes.
std::string_view arithmetic();

// Instruction sets that this machine can run the kernel with, best first, and their names. Using one other than
// the best is for tests and benchmarks; 0 goes back to the best.
std::vector<std::int64_t> instruction_sets();
std::string_view name_of(std::int64_t instruction_set);
void use_instruction_set(std::int64_t instruction_set);

}  // namespace peterka::batch
