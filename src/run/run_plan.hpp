// What a run command is to do: determined by rank 0 from the job and the file, then shared with every rank.
#pragma once

#include <filesystem>
#include <optional>

#include "job/job.hpp"
#include "map_file/inspect.hpp"
#include "map_file/map_cell.hpp"
#include "map_file/output_lock.hpp"
#include "parallel/session.hpp"
#include "run/command_line.hpp"

namespace peterka {

struct RunPlan {
    job::Job job;
    std::filesystem::path file;
    std::string job_file;                                      // on rank 0, for messages
    map_file::Existing existing = map_file::Existing::absent;  // what the file holds already
    double max_wall_seconds = 0;
    bool fresh = false;  // this and the following members are valid on rank 0 only
    bool quiet = false;
    std::optional<map_file::MapCell> map_cell;    // followed by a trace
    std::optional<map_file::OutputLock> lock;     // held until the run ends
    std::optional<map_file::FileLock> file_lock;  // of a file that exists already
};

// The map file a request writes: the one it names, or the job's stem with .h5 in the current folder.
[[nodiscard]] std::filesystem::path map_file_of(const Request& request);

// Rank 0 alone: reads the job and looks at the file. Throws Failure for either.
[[nodiscard]] RunPlan plan_run(const Request& request);

// Collective. Gives every rank rank 0's plan, or none if there is none.
void share(const parallel::Session& session, std::optional<RunPlan>& plan);

}  // namespace peterka
