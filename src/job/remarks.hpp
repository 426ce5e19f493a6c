// What is sound in a job and unlikely to be meant: told by `check` and by `run`, and no fault.
#pragma once

#include <string>
#include <vector>

#include "job/job.hpp"

namespace peterka::job {

// One sentence each: what looks as if given in another unit (doubtful_*.hpp); numbers other than those of which
// a covariance was identified, and uncertain numbers of which no rig is drawn.
[[nodiscard]] std::vector<std::string> remarks(const Job& job);

}  // namespace peterka::job
