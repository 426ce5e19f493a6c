// How hard a knock the settled hammers of a map take, in words.
#pragma once

#include <string>

#include "findings/kick_counts.hpp"
#include "job/job.hpp"

namespace peterka {

// Nothing where nobody asked.
[[nodiscard]] std::string kicks_summary(const job::Job& job, const findings::KickCounts& counts);

}  // namespace peterka
