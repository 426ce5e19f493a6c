// Spreads of [uncertainty] that are sound and look as if given as a percentage or in another unit.
#pragma once

#include <string>
#include <vector>

#include "job/job.hpp"

namespace peterka::job {

// One sentence for each. For a job whose [uncertainty] is sound.
void add_doubtful_spreads(const Job& job, std::vector<std::string>& texts);

}  // namespace peterka::job
