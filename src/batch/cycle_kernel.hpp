// The batched cycle: entry points of the kernel, chosen at run time for the machine's instruction set.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "batch/lanes.hpp"
#include "batch/rig.hpp"

namespace peterka::batch {

// Carries lanes from forcing phase 0 to forcing phase 0. Each that has come to the end of its cycle begins
// another one; whether all come to its end, too, is a part of what is wanted. Lanes in queues.twin were left to
// the scalar engine.
void run_cycle(const Rig& rig, const Grid& grid, const Lanes& lanes, Queues& queues, Wanted wanted);

// "fma" or "plain": results of machines with the same arithmetic have the same bytes.
std::string_view arithmetic();

// Instruction sets that this machine can run the kernel with, best first, and their names. Using one other than
// the best is for tests and benchmarks; 0 goes back to the best.
std::vector<std::int64_t> instruction_sets();
std::string_view name_of(std::int64_t instruction_set);
void use_instruction_set(std::int64_t instruction_set);

}  // namespace peterka::batch
