// For libFuzzer: no bytes in the place of a file of any kind crash what reads it, hang it or take gigabytes.
// Read as `run` reads the file that it finds in the place of its output, and as it reads `map = FILE`.
//
// The jobs of the files that the corpus has lie in the current folder, *.toml; the bytes are written beside
// them. FUZZ_RENEWED set: the record of the bytes is made anew first, as by a stranger who knows how, so that
// HDF5 reads what it would otherwise be kept from.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "hdf5/checked.hpp"
#include "job/read.hpp"
#include "job/write.hpp"
#include "map_file/inspect.hpp"
#include "map_file/map_cell.hpp"
#include "map_file/raw_bytes.hpp"
#include "support/errors.hpp"

namespace {

using namespace peterka;

struct KnownJob {
    job::Job job;
    std::string identity;  // as its file has it
};

std::vector<KnownJob> read_jobs() {
    hdf5::leave_open_files_alone();
    std::vector<KnownJob> jobs;
    for (const auto& entry : std::filesystem::directory_iterator(".")) {
        if (entry.path().extension() != ".toml") continue;
        const job::Job job = job::read_job_file(entry.path(), {});
        jobs.push_back({job, job::identity_text(job)});
    }
    if (jobs.empty()) std::abort();
    return jobs;
}

const job::Job& job_of(std::string_view bytes) {
    static const std::vector<KnownJob> jobs = read_jobs();
    for (const KnownJob& known : jobs) {
        if (bytes.find(known.identity) != std::string_view::npos) return known.job;
    }
    return jobs.front().job;
}

std::string with_record(std::string bytes) {
    const auto read = [&](std::uint64_t offset, std::span<std::byte> room) {
        std::memcpy(room.data(), bytes.data() + offset, room.size());
    };
    const map_file::ByteRange place = map_file::place_of_record(bytes.size());
    if (place.end - place.begin < 4096) return bytes;
    const std::string record = map_file::record_for(bytes.size(), {}, read);
    bytes.replace(place.begin, record.size(), record);
    return bytes;
}

void read_as_output(const std::filesystem::path& file, const job::Job& job) {
    try {
        static_cast<void>(map_file::inspect(file, job));
    } catch (const Failure&) {
    }
    try {
        static_cast<void>(map_file::holds_complete_map(file));
    } catch (const Failure&) {
    }
}

void read_as_map(const std::filesystem::path& file) {
    try {
        const job::Job job = map_file::read_map_job(file, "trace.map");
        static_cast<void>(map_file::read_map_cell(file, job, 0, 0));
    } catch (const Failure&) {
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const bool is_renewed = std::getenv("FUZZ_RENEWED") != nullptr;
    static const std::filesystem::path file = "fuzzed_file.h5";
    std::string bytes(reinterpret_cast<const char*>(data), size);
    if (is_renewed) bytes = with_record(std::move(bytes));
    std::ofstream(file, std::ios::binary | std::ios::trunc) << bytes;
    read_as_output(file, job_of(bytes));
    read_as_map(file);
    return 0;
}
