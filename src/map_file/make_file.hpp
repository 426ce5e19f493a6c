// Makes an empty map on disk, by one process: whole under its own name, or not there at all.
//
// Written under a temporary name in the same folder and renamed once its space is allocated, its metadata is
// written and it is closed. All functions throw Failure(ExitCode::output).
#pragma once

#include <filesystem>

#include "job/job.hpp"
#include "map_file/provenance.hpp"

namespace peterka::map_file {

// FILE.peterka-creating: the name before the file is complete with metadata; a kill may leave it behind, the
// next run replaces it.
[[nodiscard]] std::filesystem::path temporary_name(const std::filesystem::path& path);

// FILE.peterka-previous: a complete map, kept until the one that replaces it is finished.
[[nodiscard]] std::filesystem::path previous_name(const std::filesystem::path& path);

// Makes room for a new temporary file. What a run has left there is removed; anything else, a link, too, is
// somebody's and refused.
void clear_temporary(const std::filesystem::path& temporary);

// Waits until the disk has a file whole, then gives it its name, and waits until the disk has that, too.
void put_in_place(const std::filesystem::path& temporary, const std::filesystem::path& path);

// Removes previous_name(path) if it is a complete map.
void remove_previous(const std::filesystem::path& path);

// Removes what Open MPI keeps beside a file that ranks share (FILE.data.0, FILE.metadata.0, ...; empty) and a
// killed run leaves. No rank may have the file open.
void remove_files_of_mpi(const std::filesystem::path& path);

// A map already of that name is replaced: kept as previous_name(path) if it is complete. Any other kind of file
// is refused before anything is written.
void make_file(const std::filesystem::path& path, const job::Job& job, const Provenance& provenance);

}  // namespace peterka::map_file
