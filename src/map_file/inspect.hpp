// What exists at the path where a map is to be written. Serial: for one rank, before anything is opened in
// parallel.
//
// No content of a file is trusted until the sizes and types of all its datasets match the job's layout.
#pragma once

#include <filesystem>

#include "job/job.hpp"

namespace peterka::map_file {

enum class Existing {
    absent,
    resumable,  // this job's map, not finished
    complete,   // this job's map, finished
};

// Throws Failure(ExitCode::output), saying what to do, for anything else: a directory or device, a file that is
// not HDF5 or is truncated, one of another program, of another layout version or of another job (with the keys
// that differ), datasets that do not match the layout, and an unfinished map computed with another arithmetic.
[[nodiscard]] Existing inspect(const std::filesystem::path& path, const job::Job& job);

// Whether a finished map of any job exists there; false for an unfinished one or no file. Throws as above for
// what is not a map, which must not be overwritten.
[[nodiscard]] bool holds_complete_map(const std::filesystem::path& path);

}  // namespace peterka::map_file
