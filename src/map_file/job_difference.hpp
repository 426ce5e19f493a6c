// How two jobs differ, for people, from their identity texts.
#pragma once

#include <string>

namespace peterka::map_file {

// One line per key that differs, e.g. "  axes.gap_ratio.points: 256 in the file, 512 in the job"; "" if none
// does.
[[nodiscard]] std::string job_difference(const std::string& in_file, const std::string& in_job);

}  // namespace peterka::map_file
