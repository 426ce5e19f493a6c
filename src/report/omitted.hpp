// What the program left out of the model or of the work, and why that was safe: one sentence each.
#pragma once

#include <string>
#include <vector>

#include "findings/statistics.hpp"
#include "job/job.hpp"

namespace peterka {

[[nodiscard]] std::vector<std::string> omitted_in_words(const job::Job& job,
                                                        const findings::Statistics& statistics);

}  // namespace peterka
