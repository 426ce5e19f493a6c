#include "hdf5/disk_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>
#include <utility>

#include "support/errors.hpp"

namespace peterka::hdf5 {

DiskFile::DiskFile(std::filesystem::path path) : path_(std::move(path)) {
    open();
}

DiskFile::DiskFile(DiskFile&& other) noexcept
    : path_(std::move(other.path_)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      identity_(other.identity_) {}

DiskFile::~DiskFile() {
    if (descriptor_ >= 0) ::close(descriptor_);
}

void DiskFile::open() {
    descriptor_ = ::open(path_.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor_ < 0) fail("open", errno);
    struct stat status {};
    if (::fstat(descriptor_, &status) != 0) fail("fstat", errno);
    identity_ = FileIdentity::of(status);
}

void DiskFile::read(std::uint64_t offset, std::span<std::byte> bytes) const {
    while (!bytes.empty()) {
        const ssize_t count = ::pread(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) fail("pread", errno);
        if (count == 0) {
            throw Failure(ExitCode::output,
                          fmt::format("{}: ends at byte {}, before what it says it holds; it was cut short",
                                      path_.string(), offset));
        }
        bytes = bytes.subspan(static_cast<std::size_t>(count));
        offset += static_cast<std::uint64_t>(count);
    }
}

void DiskFile::write(std::uint64_t offset, std::span<const std::byte> bytes) const {
    require_presence();
    const int descriptor = ::open(path_.c_str(), O_WRONLY | O_CLOEXEC);
    if (descriptor < 0) fail("open", errno);
    int error = 0;
    while (!bytes.empty() && error == 0) {
        const ssize_t count = ::pwrite(descriptor, bytes.data(), bytes.size(), static_cast<off_t>(offset));
        if (count < 0 && errno != EINTR) error = errno;
        if (count <= 0) continue;
        bytes = bytes.subspan(static_cast<std::size_t>(count));
        offset += static_cast<std::uint64_t>(count);
    }
    ::close(descriptor);
    if (error != 0) fail("pwrite", error);
}

void DiskFile::settle() {
    while (::fsync(descriptor_) != 0) {
        if (errno == EINVAL || errno == EROFS) break;  // nothing to wait for
        if (errno != EINTR) fail("fsync", errno);
    }
    const FileIdentity before = identity_;
    ::close(std::exchange(descriptor_, -1));
    open();
    if (before == identity_) return;
    identity_ = before;
    require_presence();
}

std::uint64_t DiskFile::size() const {
    struct stat status {};
    if (::fstat(descriptor_, &status) != 0) fail("fstat", errno);
    return static_cast<std::uint64_t>(status.st_size);
}

void DiskFile::require_presence() const {
    struct stat status {};
    const bool found = ::stat(path_.c_str(), &status) == 0;
    if (!found && errno != ENOENT && errno != ENOTDIR) fail("stat", errno);
    if (found && identity_ == FileIdentity::of(status)) return;
    const char* const what = found ? "has been replaced by another file"
                                   : "has vanished: somebody removed or renamed it or its folder";
    throw Failure(
        ExitCode::output,
        fmt::format("{}: {} while the run was writing it. Put it back, or let the same command start over.",
                    path_.string(), what));
}

void DiskFile::fail(const char* call, int error) const {
    throw Failure(ExitCode::output, fmt::format("{}: {} failed: {}.", path_.string(), call,
                                                std::generic_category().message(error)));
}

}  // namespace peterka::hdf5
