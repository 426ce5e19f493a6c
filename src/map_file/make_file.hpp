// Makes an empty map on disk, by one process: complete under its own name, or absent.
//
// Written under a temporary name in the same folder and renamed once its space is allocated, its metadata is
// written and it is closed. All functions throw Failure(ExitCode::output).
#pragma once

#include <filesystem>
#include <functional>

#include "job/job.hpp"
#include "map_file/provenance.hpp"

namespace peterka::map_file {

// FILE.peterka-creating: the name before the file is complete with metadata; a kill may leave it behind, the
// next run replaces it.
[[nodiscard]] std::filesystem::path temporary_name(const std::filesystem::path& path);

// FILE.peterka-previous: a complete map, kept until the one that replaces it is finished.
[[nodiscard]] std::filesystem::path previous_name(const std::filesystem::path& path);

// Makes room for a new temporary file. What a run has left there is removed; anything else, including a link,
// is refused.
void clear_temporary(const std::filesystem::path& temporary);

// Writes a file under its temporary name, waits until it is on disk, renames it, and waits until its new name
// is on disk, too. If any of that throws, the temporary file is removed.
void make_in_place(const std::filesystem::path& path,
                   const std::function<void(const std::filesystem::path& temporary)>& write);

// Removes previous_name(path) if it is a complete map.
void remove_previous(const std::filesystem::path& path);

// Removes the empty files that Open MPI keeps beside a shared file (FILE.data.0, FILE.metadata.0, ...) and a
// killed run leaves behind. No rank may have the file open.
void remove_files_of_mpi(const std::filesystem::path& path);

// An existing map of that name is replaced, and kept as previous_name(path) if it is complete. Any other kind
// of file is refused before anything is written.
void make_file(const std::filesystem::path& path, const job::Job& job, const Provenance& provenance);

}  // namespace peterka::map_file
