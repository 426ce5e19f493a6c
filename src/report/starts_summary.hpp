// What many starts in each cell tell of a map.
#pragma once

#include <string>

#include "findings/start_findings.hpp"
#include "job/job.hpp"

namespace peterka {

// "" where the job has no [starts].
[[nodiscard]] std::string starts_summary(const job::Job& job, const findings::StartFindings& findings);

}  // namespace peterka
