// What lies at the place where a map is to be written. Serial: for one rank, before anything is opened in
// parallel.
//
// Nothing a file says is trusted before the sizes and types of all its datasets are those of the job's layout.
#pragma once

#include <filesystem>

#include "job/job.hpp"

namespace peterka::map_file {

enum class Existing {
    absent,
    resumable,  // this job's map, not finished
    complete,   // this job's map, finished
};

// Throws Failure(ExitCode::output), saying what to do, for anything else: a directory or device, no HDF5 file
// or a truncated one, a file of another program, of another layout version or of another job (with the keys
// that differ), datasets that are not as they should be, and an unfinished map that was computed with another
// arithmetic.
[[nodiscard]] Existing inspect(const std::filesystem::path& path, const job::Job& job);

// Whether a finished map lies there, of whatever job; false for an unfinished one or nothing at all. Throws as
// above for what is no map, which must not be overwritten.
[[nodiscard]] bool holds_complete_map(const std::filesystem::path& path);

}  // namespace peterka::map_file
