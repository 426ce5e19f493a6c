#include "job/job_source.hpp"

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <system_error>

#include <fmt/format.h>

#include "job/document.hpp"
#include "job/faults.hpp"

namespace peterka::job {
namespace {

constexpr std::uintmax_t largest_file = 1 << 20;  // [bytes]

void refuse_what_is_no_file(const std::filesystem::path& path) {
    std::error_code error;
    const auto status = std::filesystem::status(path, error);
    switch (status.type()) {
        case std::filesystem::file_type::regular:
            return;
        case std::filesystem::file_type::not_found:
            throw JobFaults(path.string(),
                            "there is no such file; a job is read from a TOML file; check the path");
        case std::filesystem::file_type::directory:
            throw JobFaults(path.string(), "this is a folder; a job is one TOML file; name the file inside it");
        case std::filesystem::file_type::none:
            throw JobFaults(path.string(),
                            fmt::format("cannot be looked up; the system says: {}; check the path "
                                        "and its permissions",
                                        error.message()));
        default:
            throw JobFaults(path.string(),
                            "this is a pipe, socket or device; a job is read from a regular file, by several "
                            "processes if need be; save it as a file");
    }
}

}  // namespace

std::string read_text(const std::filesystem::path& path) {
    refuse_what_is_no_file(path);
    errno = 0;
    std::ifstream file(path, std::ios::binary);
    const auto unreadable = [&] {
        const std::string reason = errno != 0 ? std::generic_category().message(errno) : "the read failed";
        return JobFaults(path.string(),
                         fmt::format("cannot be read; the system says: {}; check its permissions", reason));
    };
    if (!file) throw unreadable();
    std::string text(largest_file + 1, '\0');
    file.read(text.data(), static_cast<std::streamsize>(text.size()));
    if (file.bad()) throw unreadable();
    text.resize(static_cast<std::size_t>(file.gcount()));
    if (text.size() > largest_file) {
        throw JobFaults(path.string(),
                        "is larger than 1 MiB; a job is a page of text; check that this is the job "
                        "and not its output");
    }
    return text;
}

void refuse_what_is_no_text(std::string_view text, const std::string& file) {
    if (text.empty()) {
        throw JobFaults(file,
                        "is empty; a job names at least its kind, hammer, cart, contact and axes; start from "
                        "a copy of jobs/smoke.toml");
    }
    std::uint32_t number = 1;
    for (std::size_t begin = 0; begin <= text.size(); ++number) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        const std::string_view line = text.substr(begin, end - begin);
        if (const auto nul = line.find('\0'); nul != std::string_view::npos) {
            throw JobFaults(file,
                            {Fault{{0, number, static_cast<std::uint32_t>(nul + 1)},
                                   "a NUL byte; a job is text and this is binary; check that this is the job "
                                   "and not its output"}});
        }
        if (line.size() > longest_line) {
            throw JobFaults(file,
                            {Fault{{0, number, 1},
                                   fmt::format("a line of {} bytes; no line of a job is longer than {}; check "
                                               "that this is the job, or break the line",
                                               line.size(), longest_line)}});
        }
        begin = end + 1;
    }
}

}  // namespace peterka::job
