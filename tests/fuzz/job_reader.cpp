// For libFuzzer: no text crashes the reader of jobs or hangs it, and a job that is sound comes back equal from
// its resolved text. Lines "#! --set KEY=VALUE" are taken as overrides, as in tests/job/bad. The text is read
// from a file in the current folder, where the rigs are that jobs name.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "job/read.hpp"
#include "job/write.hpp"

namespace {

using namespace peterka::job;

std::vector<std::string> overrides_in(std::string_view text) {
    constexpr std::string_view mark = "#! --set ";
    std::vector<std::string> overrides;
    for (std::size_t at = text.find(mark); at != std::string_view::npos; at = text.find(mark, at)) {
        at += mark.size();
        overrides.emplace_back(text.substr(at, text.find('\n', at) - at));
    }
    return overrides;
}

std::optional<Job> sound_job(std::string_view text) {
    const std::filesystem::path file = "fuzzed_job.toml";
    std::ofstream(file, std::ios::binary | std::ios::trunc) << text;
    try {
        return read_job_file(file, overrides_in(text));
    } catch (const JobFaults&) {
        return std::nullopt;
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    const auto job = sound_job({reinterpret_cast<const char*>(bytes), size});
    if (!job || !job->cell.map.empty()) return 0;  // what a map's job will tell isn't known yet
    const std::string resolved = resolved_text(*job);
    if (read_job_text(resolved, "resolved") != *job || resolved_text(*job) != resolved) std::abort();
    return 0;
}
