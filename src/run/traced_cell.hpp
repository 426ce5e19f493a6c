// The cell of a map file that a trace follows, or whose rig a basin takes, at the requested place: which one it
// is, and the resulting job.
#pragma once

#include <optional>
#include <string>

#include "job/job.hpp"
#include "map_file/map_cell.hpp"

namespace peterka {

struct TracedCell {
    job::Job job;                    // complete: with the rig and the place of the cell, and without a map
    std::optional<std::string> rig;  // whose rig it is, in words; none if the job has its own
    std::optional<map_file::MapCell> map;  // what the file stores for the cell that a trace follows
};

// Reads the file that trace.map or basin.map names. Throws Failure(bad_job).
[[nodiscard]] TracedCell find_traced_cell(const job::Job& job);

}  // namespace peterka
