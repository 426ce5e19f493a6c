// The bytes of a file on disk, read by system calls.
//
// MPI-IO under HDF5 may report a failed read as a success (Open MPI's OMPIO does) and leave the buffer
// unchanged, so nothing that a run resumes from is read through it. All functions throw
// Failure(ExitCode::output) with the path and the system's reason.
#pragma once

#include <sys/stat.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

namespace peterka::hdf5 {

// The file to which a path or a descriptor refers, whatever its name.
struct FileIdentity {
    std::uint64_t device = 0;
    std::uint64_t number = 0;

    [[nodiscard]] static FileIdentity of(const struct stat& status) { return {status.st_dev, status.st_ino}; }
    friend bool operator==(const FileIdentity&, const FileIdentity&) = default;
};

class DiskFile {
  public:
    explicit DiskFile(std::filesystem::path path);
    DiskFile(DiskFile&& other) noexcept;
    DiskFile& operator=(DiskFile&&) = delete;
    ~DiskFile();

    // Reads all bytes or fails, also if the file ends before.
    void read(std::uint64_t offset, std::span<std::byte> bytes) const;

    // Writes what MPI-IO couldn't write, or wrote in part; fails with the reason.
    void write(std::uint64_t offset, std::span<const std::byte> bytes) const;

    // Waits until written data are on disk, and reopens the file, so that a node sees what others wrote.
    void settle();

    [[nodiscard]] FileIdentity identity() const { return identity_; }
    [[nodiscard]] std::uint64_t size() const;

    // Fails unless the path still refers to this file. The system accepts writes to a file that was removed or
    // replaced, and discards them at the end.
    void require_presence() const;

  private:
    void open();
    [[noreturn]] void fail(const char* call, int error) const;

    std::filesystem::path path_;
    int descriptor_ = -1;
    FileIdentity identity_;
};

}  // namespace peterka::hdf5
