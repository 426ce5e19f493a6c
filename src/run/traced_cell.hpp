// The cell of a map file whose rig a trace or a basin takes, and the resulting job. Where the job names a
// place, that is where it is computed: the cell is then the nearest one.
#pragma once

#include <optional>
#include <string>

#include "job/job.hpp"
#include "map_file/map_cell.hpp"

namespace peterka {

struct TracedCell {
    job::Job job;                    // complete: with the rig and the place of the cell, and without a map
    std::optional<std::string> rig;  // whose rig it is, in words; none if the job has its own
    std::optional<map_file::MapCell> map;  // what the file stores for the cell of a trace
};

// Reads the file that trace.map or basin.map names. Throws Failure(bad_job).
[[nodiscard]] TracedCell find_traced_cell(const job::Job& job);

}  // namespace peterka
