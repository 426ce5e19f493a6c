// The command line: the user's request, or why it cannot be understood.
#pragma once

#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace peterka {

enum class Command { run, check, print };

struct Request {
    Command command = Command::print;
    std::string text;  // print: the help or the version

    std::filesystem::path job_file;
    std::vector<std::string> overrides;  // "table.key=value"
    std::optional<std::filesystem::path> output;
    bool fresh = false;
    bool quiet = false;
    double max_wall_seconds = std::numeric_limits<double>::infinity();
};

// Throws Failure(bad_job) for a command line that cannot be understood.
[[nodiscard]] Request read_command_line(int argc, const char* const* argv);

}  // namespace peterka
