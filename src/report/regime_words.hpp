// What the cells of a map settle into, and what is left open there.
#pragma once

#include <string>

#include "findings/statistics.hpp"
#include "findings/sweep_findings.hpp"
#include "findings/transients.hpp"
#include "job/job.hpp"

namespace peterka {

// As in "1/1" or "no impact".
[[nodiscard]] std::string name_of(const MotionClass& motion);

[[nodiscard]] std::string regimes_in_words(const findings::Statistics& statistics);

// How long transient impacts last, and the share of cells still impacting after given cycles. Empty if not
// requested.
[[nodiscard]] std::string transients_in_words(const job::Job& job, const findings::Transients& ends);

}  // namespace peterka
