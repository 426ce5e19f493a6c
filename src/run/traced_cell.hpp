// The cell of a map file that a trace follows: which one it is, and the job that follows it.
#pragma once

#include <optional>

#include "job/job.hpp"
#include "map_file/map_cell.hpp"

namespace peterka {

struct TracedCell {
    job::Job job;  // complete: with the rig and the start of the cell, and without a map
    std::optional<map_file::MapCell> map;  // none where the job needed no map
};

// Reads the file that trace.map names. Throws Failure(bad_job).
[[nodiscard]] TracedCell find_traced_cell(const job::Job& job);

}  // namespace peterka
