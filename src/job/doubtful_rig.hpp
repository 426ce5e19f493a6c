// Numbers of hammer and stop that are sound and look as if given in another unit: grams, N/mm, Ns/mm, rad/s,
// percent.
#pragma once

#include <string>
#include <vector>

#include "job/job.hpp"

namespace peterka::job {

// One sentence for each. A number that differs from cell to cell is told only if it is doubtful in all cells.
void add_doubtful_rig(const Job& job, std::vector<std::string>& texts);

}  // namespace peterka::job
