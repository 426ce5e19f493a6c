// A job as text: resolved, for people and for reading back, and bare, for telling whether two jobs are the
// same.
#pragma once

#include <string>

#include "job/job.hpp"

namespace peterka::job {

// A complete job file: every key with its value, meaning and unit. It reads back equal bit for bit.
[[nodiscard]] std::string resolved_text(const Job& job);

// The same without title, limits and comments: two runs are of the same job where these texts are equal.
[[nodiscard]] std::string identity_text(const Job& job);

}  // namespace peterka::job
