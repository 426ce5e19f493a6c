// What follows from other keys of a job while it is read.
#pragma once

#include "job/job.hpp"

namespace peterka::job {

// Whether the hammer has its mass, stiffness and damping, and the cart its amplitude: what a rule must know
// before it asks what follows from them.
[[nodiscard]] bool has_rig(const Job& job);

// Numbers over which an axis runs have its first value in the job's tables: what is said of the job as a whole
// is said of its first cell.
void take_first_values(Job& job);

// The ratios of an operating point, and of a start, in SI units.
void settle_place(Job& job);
void settle_start(Job& job);

}  // namespace peterka::job
