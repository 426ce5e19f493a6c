// A job as text: resolved, for people and for reading back, and bare, for deciding whether two jobs are the
// same.
#pragma once

#include <string>

#include "job/job.hpp"
#include "job/origins.hpp"

namespace peterka::job {

// A complete job file: every key with its value, meaning and unit. It reads back equal bit for bit.
[[nodiscard]] std::string resolved_text(const Job& job);

// The same, with the origin of each value.
[[nodiscard]] std::string resolved_text(const Job& job, const Origins& origins);

// For a job that took its rig, operating point and settings from a map file: records that file as their origin.
void take_from(const std::string& map_file, const Job& job, Origins& origins);

// A job without title, limits and comments: two runs are of the same job where these texts are equal.
[[nodiscard]] std::string identity_text(const Job& job);

}  // namespace peterka::job
