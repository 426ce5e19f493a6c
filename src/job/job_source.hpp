// The text of a job file, refused early where it cannot be a job.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace peterka::job {

// Throws JobFaults for what is missing, no file, too large or not readable.
[[nodiscard]] std::string read_text(const std::filesystem::path& path);

// Throws JobFaults for an empty text, NUL bytes and lines that no job has.
void refuse_what_is_no_text(std::string_view text, const std::string& file);

}  // namespace peterka::job
