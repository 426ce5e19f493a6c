#include "map_file/whole_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <hdf5.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <iterator>
#include <span>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "hdf5/attributes.hpp"
#include "hdf5/block.hpp"
#include "hdf5/disk_file.hpp"
#include "hdf5/hdf5.hpp"
#include "map_file/inspect.hpp"
#include "map_file/make_file.hpp"
#include "map_file/make_layout.hpp"
#include "map_file/map_size.hpp"
#include "map_file/memory_file.hpp"
#include "map_file/raw_bytes.hpp"
#include "map_file/root_attributes.hpp"
#include "map_file/seal.hpp"
#include "support/errors.hpp"

namespace peterka::map_file {

namespace {

constexpr hdf5::Variable fact_variables[] = {
    {"ranks", hdf5::Number::int32, 0, "1", "ranks of the run"},
    {"compute_seconds", hdf5::Number::float64, 0, "s", "wall time of the run"},
    {"hosts", hdf5::Number::text, 0, "", "hosts of the run"},
};
constexpr hdf5::Variable whole_summary[] = {
    checksum_of_file,
    {"finished", hdf5::Number::int8, 0, "1", "1 once everything in the file is final"},
    record_of_bytes,
};

hdf5::Block whole(const DatasetPlan& plan) {
    if (plan.dimensions.size() == 1) return {0, plan.dimensions[0].size};
    return hdf5::Block(parallel::Tile{0, 0, 0, {plan.dimensions[0].size, plan.dimensions[1].size}});
}

void write_values(const hdf5::Checked& check, hid_t file, const Table& table) {
    const std::string path = table.plan.path();
    if (table.plan.dimensions.empty()) return hdf5::write_number(check, file, path.c_str(), table.values[0]);
    const hdf5::DatasetId dataset(check(H5Dopen2(file, path.c_str(), H5P_DEFAULT), "H5Dopen2"));
    hdf5::write_block(check, dataset.id(), hdf5::Number::float64, whole(table.plan), table.values.data());
}

// Where the file differs from run to run, and the record after that.
std::vector<ByteRange> unsummed(const hdf5::Checked& check, hid_t file, std::span<const DatasetPlan> plans) {
    std::vector<DatasetPlan> left_out;
    std::ranges::copy_if(plans, std::back_inserter(left_out), [](const DatasetPlan& plan) {
        return plan.group == "/run" || plan.path() == path::bytes;
    });
    return ranges_of(check, file, left_out);
}

// Returns the ranges that its record does not cover.
std::vector<ByteRange> fill_file(const hdf5::Checked& check, hid_t file, const job::Job& job,
                                 const Provenance& provenance, const Contents& contents,
                                 const RunFacts& facts) {
    write_root_attributes(check, file, job, provenance);
    for (const RootText& each : contents.texts) hdf5::write_attribute(check, file, each.name, each.text);
    std::vector<DatasetPlan> plans;
    for (const Table& table : contents.tables) plans.push_back(table.plan);
    for (const hdf5::Variable& variable : fact_variables) plans.push_back({"/run", variable, {}});
    for (const hdf5::Variable& variable : whole_summary) plans.push_back({"/summary", variable, {}});
    make_datasets(check, file, plans);
    for (const Table& table : contents.tables) write_values(check, file, table);
    hdf5::write_number(check, file, path::ranks, facts.ranks);
    hdf5::write_number(check, file, path::compute_seconds, facts.compute_seconds);
    hdf5::write_text(check, file, path::hosts, facts.hosts);
    write_seal(check, file, Sealed::whole);
    hdf5::write_number(check, file, path::finished, 1);
    return unsummed(check, file, plans);
}

[[noreturn]] void fail_to_write(const std::filesystem::path& path, const char* call, int error) {
    throw Failure(ExitCode::output, fmt::format("{}: {} failed: {}. Nothing is left of it.", path.string(),
                                                call, std::generic_category().message(error)));
}

// Writes a file that must not exist yet.
void write_bytes(const std::filesystem::path& path, std::span<const std::byte> bytes) {
    const int descriptor = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (descriptor < 0) fail_to_write(path, "open", errno);
    const char* call = "write";
    int error = 0;
    for (auto rest = bytes; !rest.empty() && error == 0;) {
        const ssize_t count = ::write(descriptor, rest.data(), rest.size());
        if (count < 0 && errno != EINTR) error = errno;
        if (count > 0) rest = rest.subspan(static_cast<std::size_t>(count));
    }
    while (error == 0 && ::fsync(descriptor) != 0) {
        call = "fsync";
        if (errno != EINTR) error = errno;
    }
    if (::close(descriptor) != 0 && error == 0) {
        call = "close";
        error = errno;
    }
    if (error != 0) fail_to_write(path, call, error);
    std::vector<std::byte> there(bytes.size());
    hdf5::DiskFile(path).read(0, there);
    if (!std::ranges::equal(there, bytes)) fail_to_write(path, "reading back what was written", EIO);
}

void put_record(std::span<std::byte> bytes, std::vector<ByteRange> unsummed) {
    unsummed.pop_back();  // that of the record itself
    const ReadBytes read = [&](std::uint64_t offset, std::span<std::byte> to) {
        std::ranges::copy(bytes.subspan(offset, to.size()), to.begin());
    };
    const std::string record = record_for(bytes.size(), std::move(unsummed), read);
    std::ranges::copy(std::as_bytes(std::span(record)), bytes.end() - std::ssize(record));
}

}  // namespace

void require_place(const std::filesystem::path& path, std::int64_t largest_bytes) {
    static_cast<void>(holds_complete_map(path));  // refuses files not made by this program
    require_space(path, largest_bytes);
    const std::filesystem::path temporary = temporary_name(path);
    clear_temporary(temporary);
    try {
        write_bytes(temporary, {});
    } catch (const Failure& failure) {
        throw Failure(ExitCode::output,
                      fmt::format("{}: no file can be made in its folder ({}). Nothing was computed; "
                                  "choose another folder with --output.",
                                  path.string(), failure.what()));
    }
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
}

void write_whole_file(const std::filesystem::path& path, const job::Job& job, const Provenance& provenance,
                      const Contents& contents, const RunFacts& facts) {
    const hdf5::Checked check(path);
    std::vector<ByteRange> unsummed;
    std::vector<std::byte> bytes = bytes_of_file(check, [&](hid_t file) {
        unsummed = fill_file(check, file, job, provenance, contents, facts);
        return unsummed.back().end;
    });
    put_record(bytes, std::move(unsummed));
    clear_temporary(temporary_name(path));
    make_in_place(path, [&](const std::filesystem::path& temporary) { write_bytes(temporary, bytes); });
}

}  // namespace peterka::map_file
