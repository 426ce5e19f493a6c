#include "output/make_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <system_error>
#include <vector>

#include "output/checked.hpp"
#include "output/inspect.hpp"
#include "output/layout.hpp"
#include "output/make_layout.hpp"
#include "output/map_size.hpp"
#include "output/root_attributes.hpp"
#include "support/errors.hpp"
#include "support/readable.hpp"

namespace peterka::output {

namespace {

std::filesystem::path with_suffix(std::filesystem::path path, const char* suffix) {
    return path += suffix;
}

// Gives the file all the room it will need, so that a full disk, a quota or a limit says so here and by the
// system's own words. HDF5 1.10 cannot close a file that it had no room to write: the program would crash at
// its end.
void reserve_room(const std::filesystem::path& path, std::int64_t bytes) {
    const int descriptor = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
    const int error = descriptor < 0 ? errno : ::posix_fallocate(descriptor, 0, bytes);
    if (descriptor >= 0) ::close(descriptor);
    if (error == 0 || error == EINVAL || error == EOPNOTSUPP) return;  // the latter: not every file system can
    std::error_code ignored;
    std::filesystem::resize_file(path, 0, ignored);
    throw Failure(
        ExitCode::output,
        fmt::format("{}: no room for {} ({} bytes): {}. Nothing was created; choose another folder with "
                    "--output, or fewer points or fields.",
                    path.string(), readable_bytes(bytes), bytes, std::generic_category().message(error)));
}

void write_whole(const std::filesystem::path& path, const job::Job& job, const Provenance& provenance,
                 std::int64_t bytes) {
    const Checked check(path);
    FileId file(
        check(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, file_creation(check).id(), file_access(check).id()),
              "H5Fcreate"));
    reserve_room(path, bytes);
    const std::vector<DatasetPlan> plans = layout(job);
    write_root_attributes(check, file.id(), job, provenance);
    make_datasets(check, file.id(), plans);
    write_coordinates(check, file.id(), plans, job);
    check(H5Fflush(file.id(), H5F_SCOPE_LOCAL), "H5Fflush");
    check(H5Fclose(file.release()), "H5Fclose");
}

void move_file(const std::filesystem::path& from, const std::filesystem::path& to) {
    std::error_code error;
    std::filesystem::rename(from, to, error);
    if (!error) return;
    throw Failure(ExitCode::output,
                  fmt::format("{}: cannot be renamed to {}: {}", from.string(), to.string(), error.message()));
}

}  // namespace

std::filesystem::path temporary_name(const std::filesystem::path& path) {
    return with_suffix(path, ".creating");
}

std::filesystem::path previous_name(const std::filesystem::path& path) {
    return with_suffix(path, ".previous");
}

void make_file(const std::filesystem::path& path, const job::Job& job, const Provenance& provenance) {
    const bool keep = holds_complete_map(path);
    const std::filesystem::path temporary = temporary_name(path);
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
    const std::int64_t bytes = predicted_bytes(job, provenance);
    require_space(path, bytes);
    try {
        write_whole(temporary, job, provenance, bytes);
    } catch (...) {
        std::filesystem::remove(temporary, ignored);
        throw;
    }
    if (keep) move_file(path, previous_name(path));
    move_file(temporary, path);
}

}  // namespace peterka::output
