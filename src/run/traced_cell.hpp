// The cell of a map file that a trace follows, or whose rig and place a basin has: which one it is, and the job
// that comes of it.
#pragma once

#include <filesystem>
#include <optional>

#include "job/job.hpp"
#include "map_file/map_cell.hpp"
#include "parallel/tiles.hpp"

namespace peterka {

struct CellInMap {
    std::filesystem::path file;
    parallel::Place cell;
};

struct TracedCell {
    job::Job job;                  // complete: with the rig and the place of the cell, and without a map
    std::optional<CellInMap> rig;  // whose rig it is; none where the job has its own
    std::optional<map_file::MapCell> map;  // what the file stores of the cell that a trace follows
};

// Reads the file that trace.map or basin.map names. Throws Failure(bad_job).
[[nodiscard]] TracedCell find_traced_cell(const job::Job& job);

}  // namespace peterka
