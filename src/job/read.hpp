// Reads a job file, strictly: all faults are listed at once, and a returned job is valid.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "job/faults.hpp"
#include "job/job.hpp"
#include "job/origins.hpp"

namespace peterka::job {

// `overrides` are texts of the form table.key=value, later ones over earlier ones. Throws JobFaults.
[[nodiscard]] Job read_job_file(const std::filesystem::path& path, std::span<const std::string> overrides = {});

// The same for a text in memory, which names no rig file; `name` stands for the file in messages.
[[nodiscard]] Job read_job_text(std::string_view text, const std::string& name,
                                std::span<const std::string> overrides = {});

// A job with the origin of each of its values.
struct JobWithOrigins {
    Job job;
    Origins origins;
};
[[nodiscard]] JobWithOrigins read_job_with_origins(const std::filesystem::path& path,
                                                   std::span<const std::string> overrides);

}  // namespace peterka::job
