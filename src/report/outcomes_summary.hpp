// What the rigs drawn for each cell show about a map.
#pragma once

#include <string>

#include "findings/outcome_findings.hpp"
#include "job/job.hpp"

namespace peterka {

// "" where the job has no [uncertainty].
[[nodiscard]] std::string outcomes_summary(const job::Job& job, const findings::OutcomeFindings& findings);

// How many draws were drawn again since they lay outside the range of a key, as a sentence; "" if none were.
[[nodiscard]] std::string drawn_again_in_words(const job::Job& job);

}  // namespace peterka
