#include "map_file/make_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "hdf5/checked.hpp"
#include "hdf5/disk_file.hpp"
#include "map_file/inspect.hpp"
#include "map_file/layout.hpp"
#include "map_file/make_layout.hpp"
#include "map_file/map_size.hpp"
#include "map_file/raw_bytes.hpp"
#include "map_file/root_attributes.hpp"
#include "map_file/seal.hpp"
#include "support/errors.hpp"
#include "support/folder.hpp"
#include "support/readable.hpp"

namespace peterka::map_file {

namespace {

std::filesystem::path with_suffix(std::filesystem::path path, const char* suffix) {
    return path += suffix;
}

// Allocates all the space the file will need, so that a full disk, a quota or a limit is reported here, with
// the system's own message. HDF5 1.10 cannot close a file that it had no space to write: the program would
// crash at its end.
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

// Releases what was reserved after the last dataset, should another release of HDF5 take less than predicted:
// the record is the file's end.
void give_back_room(const std::filesystem::path& path, const std::vector<ByteRange>& numbers) {
    const std::uint64_t end = std::ranges::max(numbers, {}, &ByteRange::end).end;
    std::error_code error;
    if (std::filesystem::file_size(path, error) > end && !error) std::filesystem::resize_file(path, end, error);
    if (!error) return;
    throw Failure(ExitCode::output,
                  fmt::format("{}: can't be made as long as it is to be: {}", path.string(), error.message()));
}

void write_whole(const std::filesystem::path& path, const job::Job& job, const Provenance& provenance,
                 std::int64_t bytes) {
    const hdf5::Checked check(path);
    hdf5::FileId file(
        check(H5Fcreate(path.c_str(), H5F_ACC_EXCL, file_creation(check).id(), file_access(check).id()),
              "H5Fcreate"));
    reserve_room(path, bytes);
    const std::vector<DatasetPlan> plans = layout(job);
    write_root_attributes(check, file.id(), job, provenance);
    make_datasets(check, file.id(), plans);
    write_coordinates(check, file.id(), plans, job);
    write_seal(check, file.id(), Sealed::frame);
    std::vector<ByteRange> numbers = ranges_of(check, file.id(), plans);
    check(H5Fflush(file.id(), H5F_SCOPE_LOCAL), "H5Fflush");
    check(H5Fclose(file.release()), "H5Fclose");
    give_back_room(path, numbers);
    write_record(path, std::move(numbers));
}

// Does not follow links.
bool is_plain_file(const std::filesystem::path& path) {
    struct stat status {};
    return ::lstat(path.c_str(), &status) == 0 && S_ISREG(status.st_mode) && status.st_nlink == 1;
}

bool is_complete_map(const std::filesystem::path& path) {
    try {
        return is_plain_file(path) && holds_complete_map(path);
    } catch (const Failure&) {
        return false;
    }
}

// Whether a file begins as one that HDF5 has made or was about to: empty, zeros, or its signature.
bool begins_as_ours(const std::filesystem::path& path) {
    constexpr std::string_view signature("\x89HDF\r\n\x1a\n", 8);
    std::string begin(signature.size(), '\0');
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_CLOEXEC);
    if (descriptor < 0) return false;
    const ssize_t length = ::pread(descriptor, begin.data(), begin.size(), 0);
    ::close(descriptor);
    return length >= 0 && (begin == signature || begin.find_first_not_of('\0') == std::string::npos);
}

void require_room_for_previous(const std::filesystem::path& path) {
    struct stat status {};
    const std::filesystem::path previous = previous_name(path);
    if (::lstat(previous.c_str(), &status) != 0 || is_complete_map(previous)) return;
    throw Failure(ExitCode::output,
                  fmt::format("{}: is no map of peterka, and the map to be replaced would be kept "
                              "under that name. Move it away.",
                              previous.string()));
}

// Names belong to the folder, and survive a power failure once the folder is on the disk.
void settle_folder_of(const std::filesystem::path& path) {
    const int descriptor = ::open(folder_of(path).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0) return;  // a folder may be writable but not readable
    int error = 0;
    while (::fsync(descriptor) != 0 && (error = errno) == EINTR) error = 0;
    ::close(descriptor);
    if (error == 0 || error == EINVAL || error == EROFS) return;  // the latter: nothing to wait for
    throw Failure(ExitCode::output, fmt::format("{}: fsync of its folder failed: {}.", path.string(),
                                                std::generic_category().message(error)));
}

void move_file(const std::filesystem::path& from, const std::filesystem::path& to) {
    std::error_code error;
    std::filesystem::rename(from, to, error);
    if (!error) return;
    throw Failure(ExitCode::output,
                  fmt::format("{}: cannot be renamed to {}: {}", from.string(), to.string(), error.message()));
}

// FILE.data.3, with the number of a rank.
bool is_of_mpi(const std::string& name, const std::string& file) {
    for (const std::string& begin : {file + ".data.", file + ".metadata."}) {
        if (name.starts_with(begin) && name.size() > begin.size() &&
            name.find_first_not_of("0123456789", begin.size()) == std::string::npos)
            return true;
    }
    return false;
}

}  // namespace

std::filesystem::path temporary_name(const std::filesystem::path& path) {
    return with_suffix(path, ".peterka-creating");
}

std::filesystem::path previous_name(const std::filesystem::path& path) {
    return with_suffix(path, ".peterka-previous");
}

void clear_temporary(const std::filesystem::path& temporary) {
    struct stat status {};
    if (::lstat(temporary.c_str(), &status) != 0) return;
    if (!is_plain_file(temporary) || !begins_as_ours(temporary)) {
        throw Failure(ExitCode::output,
                      fmt::format("{}: is in the way, and no run of peterka has left it. Move it "
                                  "away, or choose another name with --output.",
                                  temporary.string()));
    }
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
}

void make_in_place(const std::filesystem::path& path,
                   const std::function<void(const std::filesystem::path&)>& write) {
    const std::filesystem::path temporary = temporary_name(path);
    try {
        write(temporary);
        hdf5::DiskFile(temporary).settle();
        move_file(temporary, path);
        settle_folder_of(path);
    } catch (...) {
        std::error_code ignored;
        std::filesystem::remove(temporary, ignored);
        throw;
    }
}

void remove_previous(const std::filesystem::path& path) {
    std::error_code ignored;
    if (is_complete_map(previous_name(path))) std::filesystem::remove(previous_name(path), ignored);
}

void remove_files_of_mpi(const std::filesystem::path& path) {
    std::error_code ignored;
    for (const std::string& name : names_in(folder_of(path))) {
        if (!is_of_mpi(name, path.filename().string())) continue;
        const std::filesystem::path each = folder_of(path) / name;
        if (is_plain_file(each) && std::filesystem::is_empty(each, ignored))
            std::filesystem::remove(each, ignored);
    }
}

void make_file(const std::filesystem::path& path, const job::Job& job, const Provenance& provenance) {
    const bool keep = holds_complete_map(path);
    if (keep) require_room_for_previous(path);
    clear_temporary(temporary_name(path));
    const std::int64_t bytes = predicted_bytes(job, provenance);
    require_space(path, bytes);
    make_in_place(path, [&](const std::filesystem::path& temporary) {
        write_whole(temporary, job, provenance, bytes);
        if (keep) move_file(path, previous_name(path));
    });
}

}  // namespace peterka::map_file
