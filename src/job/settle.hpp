// Values of a job that follow from its other keys while it is read.
#pragma once

#include "job/job.hpp"

namespace peterka::job {

// Whether the hammer has its mass, stiffness and damping, and the cart its amplitude: required by rules over
// numbers derived from them.
[[nodiscard]] bool has_rig(const Job& job);

// Numbers that an axis varies get its first value in the job's tables: statements about the job as a whole
// refer to its first cell.
void take_first_values(Job& job);

// Sets the ratios of an operating point, and of a start, from values in SI units.
void settle_place(Job& job);
void settle_start(Job& job);

}  // namespace peterka::job
