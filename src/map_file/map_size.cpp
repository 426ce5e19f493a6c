#include "map_file/map_size.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <limits>
#include <span>
#include <system_error>
#include <vector>

#include "hdf5/checked.hpp"
#include "hdf5/hdf5.hpp"
#include "map_file/layout.hpp"
#include "map_file/make_layout.hpp"
#include "map_file/root_attributes.hpp"
#include "support/errors.hpp"
#include "support/readable.hpp"

namespace peterka::map_file {

namespace {

std::int64_t data_bytes(std::span<const DatasetPlan> plans) {
    std::int64_t sum = 0;
    for (const DatasetPlan& plan : plans) {
        if (__builtin_add_overflow(sum, plan.bytes(), &sum)) return std::numeric_limits<std::int64_t>::max();
    }
    return sum;
}

// The smallest number that takes as many bytes as this one, at most three.
std::int64_t smallest_of_its_bytes(std::int64_t number) {
    std::int64_t smallest = 1;
    while (smallest < 65536 && number / 256 >= smallest) smallest *= 256;
    return smallest;
}

// Metadata do not depend on the number of cells, except that HDF5 stores chunk sides in as many bytes as the
// largest needs, and a branch of a sweep is one chunk.
void leave_few_cells(job::Job& job) {
    job.rows.points = 1;
    if (job.kind != job::Kind::sweep) {
        job.columns.points = 1;
        return;
    }
    for (std::vector<double>* gaps : {&job.sweep.gap_ratio, &job.sweep.gap_m}) {
        if (gaps->size() > 1) *gaps = {gaps->front()};
    }
    job.columns.points = smallest_of_its_bytes(job.columns.points);
    job.sweep.samples = smallest_of_its_bytes(job.sweep.samples);
}

// Measured on the file of the same job with few cells, made in memory.
std::int64_t metadata_bytes(job::Job job, const Provenance& provenance) {
    const hdf5::Checked check("(file in memory)");
    const hdf5::PropertiesId access = file_access(check);
    check(H5Pset_fapl_core(access.id(), 1, false), "H5Pset_fapl_core");
    const hdf5::FileId file(
        check(H5Fcreate("size", H5F_ACC_TRUNC, file_creation(check).id(), access.id()), "H5Fcreate"));
    write_root_attributes(check, file.id(), job, provenance);
    leave_few_cells(job);
    const std::vector<DatasetPlan> plans = layout(job);
    make_datasets(check, file.id(), plans);
    check(H5Fflush(file.id(), H5F_SCOPE_LOCAL), "H5Fflush");
    hsize_t size = 0;
    check(H5Fget_filesize(file.id(), &size), "H5Fget_filesize");
    return static_cast<std::int64_t>(size) - data_bytes(plans);
}

}  // namespace

std::int64_t predicted_bytes(const job::Job& job) {
    return predicted_bytes(job, collect_provenance());
}

std::int64_t predicted_bytes(const job::Job& job, const Provenance& provenance) {
    std::int64_t sum = data_bytes(layout(job));
    if (__builtin_add_overflow(sum, metadata_bytes(job, provenance), &sum)) {
        return std::numeric_limits<std::int64_t>::max();
    }
    return sum;
}

void require_space(const std::filesystem::path& path, std::int64_t bytes) {
    const std::filesystem::path folder = folder_of(path);
    std::error_code error;
    if (std::filesystem::exists(folder, error) && ::access(folder.c_str(), W_OK) != 0) {
        throw Failure(ExitCode::output,
                      fmt::format("{}: the folder {} cannot be written: {}. Choose another one with "
                                  "--output.",
                                  path.string(), folder.string(), std::generic_category().message(errno)));
    }
    const std::filesystem::space_info space = std::filesystem::space(folder, error);
    if (error) {
        throw Failure(
            ExitCode::output,
            fmt::format("{}: the folder {} cannot be used: {}. Make it, or choose another one with --output.",
                        path.string(), folder.string(), error.message()));
    }
    if (bytes >= 0 && static_cast<std::uintmax_t>(bytes) <= space.available) return;
    const auto available = static_cast<std::int64_t>(space.available);
    throw Failure(ExitCode::output,
                  fmt::format("{}: the file needs {} ({} bytes), but {} has {} left ({} bytes). Nothing was "
                              "created; choose another folder with --output, or fewer points or fields.",
                              path.string(), readable_bytes(bytes), bytes, folder.string(),
                              readable_bytes(available), available));
}

std::filesystem::path folder_of(const std::filesystem::path& path) {
    return path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
}

}  // namespace peterka::map_file
