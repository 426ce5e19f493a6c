// The batched cycle: entry points of the kernel, dispatched at run time on the machine's instruction set.
//
// Each carries lanes from forcing phase 0 to forcing phase 0. Lanes at the end of their cycle begin another
// one; `whole`: all reach its end, otherwise some events may wait for more of their kind, to fill the vectors,
// and the next call continues with them. Lanes in queues.twin were left to the scalar engine. Force, bound of
// |u| and Jacobian are always computed: searches need all three. Each law has its own file, so that all are
// compiled in parallel.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "batch/lanes.hpp"
#include "batch/rig.hpp"

namespace peterka::batch {

// A spring-dashpot stop with linear springs, or with a cubic part; a rigid stop with linear springs.
void run_linear_cycle(const Rig& rig, const Grid& grid, const Lanes& lanes, Queues& queues, bool whole);
void run_split_cycle(const Rig& rig, const Grid& grid, const Lanes& lanes, Queues& queues, bool whole);
void run_rigid_cycle(const Rig& rig, const Grid& grid, const Lanes& lanes, Queues& queues, bool whole);

// The same for cells that differ in springs, dampers and stop, without a common Rig: each lane holds these
// numbers itself, and every contact is followed as one of any length, since the analysis of short contacts in
// rig.hpp costs as much as some hundred of them.
void run_own_rigs_cycle(const Grid& grid, const Lanes& lanes, Queues& queues, bool whole);
void run_own_rigs_split_cycle(const Grid& grid, const Lanes& lanes, Queues& queues, bool whole);
void run_own_rigs_rigid_cycle(const Grid& grid, const Lanes& lanes, Queues& queues, bool whole);

// "fma" or "plain": machines with the same arithmetic give bitwise equal results.
std::string_view arithmetic();

// Instruction sets with which this machine can run the kernel, best first, and their names. Others than the
// best are for tests and benchmarks; 0 restores the best.
std::vector<std::int64_t> instruction_sets();
std::string_view name_of(std::int64_t instruction_set);
void use_instruction_set(std::int64_t instruction_set);

}  // namespace peterka::batch
