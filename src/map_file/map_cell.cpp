#include "map_file/map_cell.hpp"

#include <fmt/format.h>

#include <system_error>

#include "hdf5/attributes.hpp"
#include "job/faults.hpp"
#include "job/names.hpp"
#include "job/read.hpp"
#include "map_file/layout.hpp"
#include "map_file/make_layout.hpp"
#include "map_file/matches_plan.hpp"
#include "map_file/raw_bytes.hpp"
#include "map_file/root_attributes.hpp"
#include "map_file/seal.hpp"
#include "map_file/tile_store.hpp"
#include "support/errors.hpp"

namespace peterka::map_file {

namespace {

const std::string key_of_traces = "trace.map";

[[noreturn]] void refuse(const std::filesystem::path& path, const std::string& why,
                         const std::string& key = key_of_traces) {
    throw Failure(ExitCode::bad_job,
                  fmt::format("{} = \"{}\" {}; give a file that peterka made of a map or basin", key,
                              path.string(), why));
}

hdf5::FileId open_to_read(const hdf5::Checked& check, const std::string& key) {
    const std::filesystem::path& path = check.path();
    std::error_code unknown;
    if (!std::filesystem::exists(path, unknown))
        refuse(path, "does not exist (looked for from the current folder)", key);
    if (!std::filesystem::is_regular_file(path, unknown)) refuse(path, "is not a regular file", key);
    if (H5Fis_hdf5(path.c_str()) <= 0) refuse(path, "is not an HDF5 file, or may not be read", key);
    if (const std::string fault = fault_in_bytes(check); !fault.empty()) refuse(path, fault, key);
    const hdf5::PropertiesId access = file_access(check);
    hdf5::FileId file(H5Fopen(path.c_str(), H5F_ACC_RDONLY, access.id()));
    if (file.id() < 0) refuse(path, "is damaged: " + hdf5::hdf5_reason(), key);
    return file;
}

// Rig and axes are trusted if the file's own run would trust them. Cells have checksums of their own.
void require_trust(const hdf5::Checked& check, const hdf5::FileId& file, const std::string& key) {
    try {
        if (is_sealed(check, file.id(), says_finished(check, file.id()) ? Sealed::whole : Sealed::frame))
            return;
    } catch (const Failure&) {  // the seal covers the contents, and these are impossible
    }
    refuse(check.path(), "is damaged: something outside its cells is not what was written (wrong checksum)",
           key);
}

job::Job job_in(const std::filesystem::path& path, const hdf5::FileId& file, const std::string& key) {
    const auto version = hdf5::read_integer(file.id(), attribute::layout);
    const auto text = hdf5::read_text(file.id(), attribute::job);
    if (!version || !text) refuse(path, "was not made by peterka: it has no layout version or no job", key);
    if (*version < oldest_readable || *version > layout_version) {
        refuse(path,
               fmt::format("has layout version {}, this program reads versions {} to {}", *version,
                           oldest_readable, layout_version),
               key);
    }
    try {
        job::Job job = job::read_job_text(*text, path.string());
        job.layout = static_cast<int>(*version);
        return job;
    } catch (const job::JobFaults&) {
        refuse(path, "holds a job that this version can't read", key);
    }
}

}  // namespace

job::Job read_map_job(const std::filesystem::path& path, const std::string& key) {
    const hdf5::Checked check(path);
    const hdf5::FileId file = open_to_read(check, key);
    job::Job job = job_in(path, file, key);
    require_trust(check, file, key);
    if (job.kind == job::Kind::map || job.kind == job::Kind::basin) return job;
    refuse(path, fmt::format("is of kind \"{}\", which has no plane of cells", job::name(job.kind)), key);
}

MapCell read_map_cell(const std::filesystem::path& path, const job::Job& job, std::int64_t row,
                      std::int64_t column) {
    const hdf5::Checked check(path);
    const hdf5::FileId file = open_to_read(check, key_of_traces);
    if (const auto fault = layout_fault(check, file.id(), job)) refuse(path, "is damaged: " + *fault);
    const hdf5::DiskFile disk(path);
    const TileStore tiles({check, file.id(), disk}, job);
    const parallel::Tile tile = tiles.tiling().tile(tiles.tiling().index_at({row, column}));
    const auto in_words = [&](const char* what) {
        return fmt::format("{} the cell in row {}, column {}", what, row, column);
    };
    try {
        switch (tiles.state(tile)) {
            case TileState::missing:
                refuse(path, in_words("has not computed yet"));
            case TileState::damaged:
                refuse(path, in_words("is damaged (wrong checksum) at"));
            case TileState::whole:
                break;
        }
        return {
            .file = path, .row = row, .column = column, .job = job, .stored = tiles.read_cell({row, column})};
    } catch (const Failure& failure) {
        if (failure.code() == ExitCode::bad_job) throw;
        refuse(path, "can't be read: " + std::string(failure.what()));
    }
}

}  // namespace peterka::map_file
