#include "map_file/inspect.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include "cell/labels.hpp"
#include "hdf5/attributes.hpp"
#include "hdf5/block.hpp"
#include "hdf5/checked.hpp"
#include "hdf5/hdf5.hpp"
#include "hdf5/stored.hpp"
#include "job/write.hpp"
#include "map_file/arithmetic.hpp"
#include "map_file/job_difference.hpp"
#include "map_file/layout.hpp"
#include "map_file/make_layout.hpp"
#include "map_file/matches_plan.hpp"
#include "map_file/provenance.hpp"
#include "map_file/raw_bytes.hpp"
#include "map_file/root_attributes.hpp"
#include "map_file/seal.hpp"
#include "support/errors.hpp"
#include "support/escape_untrusted.hpp"

namespace peterka::map_file {

namespace {

constexpr const char* other_name = "Choose another name with --output, or remove the file yourself.";
constexpr const char* not_trusted = "Don't trust it; compute it again with --fresh, or under another name.";
constexpr const char* start_over = "Start over with --fresh, or choose another name with --output.";

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& why, const char* what_to_do) {
    throw Failure(ExitCode::output, fmt::format("{}: {}. {}", path.string(), why, what_to_do));
}

// Whether anything exists there; only a regular file is accepted.
bool holds_file(const std::filesystem::path& path) {
    std::error_code error;
    const auto status = std::filesystem::status(path, error);
    if (status.type() == std::filesystem::file_type::not_found) return false;
    if (error) refuse(path, "cannot be looked at: " + error.message(), other_name);
    if (std::filesystem::is_directory(status)) refuse(path, "is a directory", other_name);
    if (!std::filesystem::is_regular_file(status)) refuse(path, "is not a regular file", other_name);
    return true;
}

hdf5::FileId open_map(const hdf5::Checked& check) {
    const std::filesystem::path& path = check.path();
    const htri_t is_hdf5 = H5Fis_hdf5(path.c_str());
    if (is_hdf5 < 0) refuse(path, "cannot be read: " + hdf5::hdf5_reason(), other_name);
    if (is_hdf5 == 0) refuse(path, "is not an HDF5 file, so not a map", other_name);
    if (const std::string fault = fault_in_bytes(check); !fault.empty())
        refuse(path, fault, are_broken(path) ? not_trusted : other_name);
    const hdf5::PropertiesId access =
        file_access(check);  // outlives the call: closing it would clear HDF5's reason
    hdf5::FileId file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, access.id()));
    if (file.id() < 0) refuse(path, "is damaged: " + hdf5::hdf5_reason(), other_name);
    if (!hdf5::read_integer(file.id(), attribute::layout)) {
        refuse(path, "was not made by peterka: it has no layout version", other_name);
    }
    return file;
}

const char* what_it_lacks(int version) {
    if (version == 1) return ": files of version 1 have no checksum over what lies outside their cells";
    if (version == 2) return ": files of version 2 don't say of each label whether rounding may decide it";
    return "";
}

void require_layout_version(const std::filesystem::path& path, const hdf5::FileId& file) {
    const int version = hdf5::read_integer(file.id(), attribute::layout).value_or(0);
    if (version == layout_version) return;
    refuse(path,
           fmt::format("has layout version {}, this program writes version {}{}", version, layout_version,
                       what_it_lacks(version)),
           start_over);
}

void require_job(const std::filesystem::path& path, const hdf5::FileId& file, const job::Job& job) {
    const std::string in_file = hdf5::read_text(file.id(), attribute::job_identity).value_or("");
    const std::string in_job = job::identity_text(job);
    if (in_file == in_job) return;
    throw Failure(ExitCode::output, fmt::format("{}: belongs to another job:{}\n{}", path.string(),
                                                job_difference(in_file, in_job), start_over));
}

void require_datasets(const hdf5::Checked& check, const hdf5::FileId& file, const job::Job& job) {
    if (const auto fault = layout_fault(check, file.id(), job)) {
        refuse(check.path(), "is damaged: " + *fault, start_over);
    }
    for (const DatasetPlan& plan : layout(job)) {
        if (!holds_coordinates(check, file.id(), plan, job)) {
            refuse(check.path(),
                   fmt::format("is damaged: dataset {} has values that are not the job's", plan.path()),
                   start_over);
        }
    }
}

// The tiles' checksums are verified by all ranks together (MapFile::remaining_tiles).
void require_seal(const hdf5::Checked& check, const hdf5::FileId& file, Sealed part) {
    if (is_sealed(check, file.id(), part)) return;
    refuse(check.path(),
           fmt::format(
               "is damaged: something outside its cells is not what it was when it was {} (wrong checksum)",
               part == Sealed::whole ? "finished" : "made"),
           "Don't trust it; compute it again with --fresh.");
}

bool all_tiles_done(const hdf5::Checked& check, const hdf5::FileId& file, const job::Job& job) {
    constexpr std::int64_t at_once = 1'000'000;
    const hdf5::DiskFile disk(check.path());
    const hdf5::Stored marks({check, file.id(), disk}, path::done, hdf5::Number::int8);
    const std::int64_t tiles = tiling(job).count();
    for (std::int64_t first = 0; first < tiles; first += at_once) {
        std::vector<std::int8_t> done(static_cast<std::size_t>(std::min(at_once, tiles - first)));
        marks.read(hdf5::Block(first, std::ssize(done)), done.data());
        if (std::ranges::any_of(done, [](std::int8_t mark) { return mark != 1; })) return false;
    }
    return true;
}

// The file records which cells SUNDIALS integrated from [start]. From other starts, or with other rigs, it may
// have integrated any cell, and it does the audit, which follows the last tile.
bool holds_what_sundials_carried(const hdf5::Checked& check, const hdf5::FileId& file, const job::Job& job) {
    const bool tries_more = job.starts.count > 0 || job.uncertainty.rigs > 0;
    if (tries_more || (job.audit.cells > 0 && all_tiles_done(check, file, job))) return true;
    const hdf5::DiskFile disk(check.path());
    const hdf5::Stored engines({check, file.id(), disk}, path::engine, hdf5::Number::int8);
    const parallel::Tiling tiles = tiling(job);
    for (std::int64_t i = 0; i < tiles.count(); ++i) {
        const hdf5::Block cells(tiles.tile(i));
        std::vector<std::int8_t> carried_by(engines.bytes(cells));
        engines.read(cells, carried_by.data());
        const bool integrated = std::ranges::any_of(carried_by, [](std::int8_t engine) {
            return engine == static_cast<std::int8_t>(cell::Engine::cvode) ||
                   engine == static_cast<std::int8_t>(cell::Engine::arkode);
        });
        if (integrated) return true;
    }
    return false;
}

void refuse_to_go_on(const std::filesystem::path& path, const std::string& with, const std::string& in_file,
                     const std::string& here) {
    refuse(path,
           fmt::format("was computed with {} ({}; this machine: {}), so the rest would not fit to the last bit",
                       with, escape_untrusted(in_file), here),
           "Resume on a machine like the first, or start over with --fresh.");
}

void require_arithmetic(const hdf5::Checked& check, const hdf5::FileId& file, const job::Job& job) {
    const auto in_file = [&](const char* name) {
        return hdf5::read_text(file.id(), name).value_or("nothing known");
    };
    const std::string computed_with = in_file(attribute::arithmetic);
    if (computed_with != arithmetic())
        refuse_to_go_on(check.path(), "other arithmetic", computed_with, arithmetic());
    const std::string integrated_with = in_file(attribute::sundials);
    if (integrated_with != sundials_version() && holds_what_sundials_carried(check, file, job))
        refuse_to_go_on(check.path(), "another release of SUNDIALS", integrated_with, sundials_version());
}

}  // namespace

Existing inspect(const std::filesystem::path& path, const job::Job& job) {
    if (!holds_file(path)) return Existing::absent;
    const hdf5::Checked check(path);
    const hdf5::FileId file = open_map(check);
    require_layout_version(path, file);
    require_job(path, file, job);
    const bool is_whole =
        job.kind == job::Kind::study || job.kind == job::Kind::trace || job.kind == job::Kind::curves;
    if (is_whole) {  // it was written at once, and none of its numbers is examined
        require_seal(check, file, Sealed::whole);
        return Existing::complete;
    }
    require_datasets(check, file, job);
    if (says_finished(check, file.id()) && all_tiles_done(check, file, job)) {
        require_seal(check, file, Sealed::whole);
        return Existing::complete;
    }
    require_arithmetic(check, file, job);
    require_seal(check, file, Sealed::frame);
    if (::access(path.c_str(), W_OK) != 0) {
        const std::string reason = std::generic_category().message(errno);
        refuse(path, "is not finished and cannot be written: " + reason,
               "Make it writable, or go on with a copy.");
    }
    return Existing::resumable;
}

bool holds_complete_map(const std::filesystem::path& path) {
    if (!holds_file(path)) return false;
    if (are_broken(path)) return false;  // of this program, and not worth keeping
    const hdf5::Checked check(path);
    const hdf5::FileId file = open_map(check);
    return says_finished(check, file.id());
}

}  // namespace peterka::map_file
