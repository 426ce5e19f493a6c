// A job as text: resolved, for people and for reading back, and bare, for telling whether two jobs are the
// same.
#pragma once

#include <string>

#include "job/job.hpp"
#include "job/origins.hpp"

namespace peterka::job {

// A complete job file: every key with its value, meaning and unit. It reads back equal bit for bit.
[[nodiscard]] std::string resolved_text(const Job& job);

// The same with where each value came from.
[[nodiscard]] std::string resolved_text(const Job& job, const Origins& origins);

// Of a job that took its rig, place and settings from a map file: that is where they came from.
void take_from(const std::string& map_file, const Job& job, Origins& origins);

// A job without title, limits and comments: two runs are of the same job where these texts are equal.
[[nodiscard]] std::string identity_text(const Job& job);

}  // namespace peterka::job
