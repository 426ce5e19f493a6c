// How large a map file will be, and whether it fits, before anything is created.
#pragma once

#include <cstdint>
#include <filesystem>

#include "job/job.hpp"
#include "map_file/provenance.hpp"

namespace peterka::map_file {

// Size of the job's file [bytes], exact; the largest std::int64_t on overflow.
[[nodiscard]] std::int64_t predicted_bytes(const job::Job& job);
[[nodiscard]] std::int64_t predicted_bytes(const job::Job& job, const Provenance& provenance);

// Throws Failure(ExitCode::output), naming both numbers, if the folder of `path` has fewer bytes left.
void require_space(const std::filesystem::path& path, std::int64_t bytes);

// The folder that a file lies in; "." for a bare name.
[[nodiscard]] std::filesystem::path folder_of(const std::filesystem::path& path);

}  // namespace peterka::map_file
