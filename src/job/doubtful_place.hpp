// Frequencies, gaps, starts and times that are sound and look as if given in another unit: millimetres, rad/s,
// kHz, milliseconds, or as the ratio of the other key.
#pragma once

#include <string>
#include <vector>

#include "job/job.hpp"

namespace peterka::job {

// One sentence for each.
void add_doubtful_place(const Job& job, std::vector<std::string>& texts);

}  // namespace peterka::job
