// The check command: what a job means and what it costs, without computing anything.
#pragma once

#include <string>

#include "run/command_line.hpp"

namespace peterka {

// The resolved job with a header of comments: cells, tiles, memory and file size. It is itself a job file that
// reads back as the same job. Throws JobFaults.
[[nodiscard]] std::string check_job(const Request& request);

}  // namespace peterka
