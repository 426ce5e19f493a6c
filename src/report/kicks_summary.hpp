// The kicks that the settled motions of a map withstand, in words.
#pragma once

#include <string>

#include "findings/kick_counts.hpp"
#include "job/job.hpp"

namespace peterka {

// Empty if not requested.
[[nodiscard]] std::string kicks_summary(const job::Job& job, const findings::KickCounts& counts);

}  // namespace peterka
