// The text of a job file, rejected early if it cannot be a job.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace peterka::job {

// Throws JobFaults if the path is missing, not a file, too large or not readable.
[[nodiscard]] std::string read_text(const std::filesystem::path& path);

// Throws JobFaults for an empty text, NUL bytes and overlong lines.
void refuse_what_is_no_text(std::string_view text, const std::string& file);

}  // namespace peterka::job
