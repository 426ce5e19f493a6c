// The nondimensional numbers of a rig as comment lines, for people who read a resolved job.
#pragma once

#include <string>

#include "job/job.hpp"

namespace peterka::job {

[[nodiscard]] std::string derived_numbers_in_words(const Job& job);

}  // namespace peterka::job
