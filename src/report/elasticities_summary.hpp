// What the peak force, or on a rigid stop the impact speed, of a map's commonest orbits depends on.
#pragma once

#include <string>

#include "findings/statistics.hpp"
#include "job/job.hpp"

namespace peterka {

// "" where no elasticity is requested, or no orbit has one.
[[nodiscard]] std::string elasticities_summary(const job::Job& job, const findings::Statistics& statistics);

}  // namespace peterka
