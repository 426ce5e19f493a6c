// The bytes of a file as the disk has them, read by the system's own call.
//
// MPI-IO under HDF5 may call a read that failed a success (Open MPI's OMPIO does) and leave in memory whatever
// was there, so nothing that a run goes on from is read through it. All functions throw
// Failure(ExitCode::output) with the path and the system's reason.
#pragma once

#include <sys/stat.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

namespace peterka::hdf5 {

// Which file a path or a descriptor leads to, whatever its name.
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

    // All of them, or a failure: a file that ends before is one.
    void read(std::uint64_t offset, std::span<std::byte> bytes) const;

    // For what MPI-IO couldn't write, or wrote in part: writes it, or says why not.
    void write(std::uint64_t offset, std::span<const std::byte> bytes) const;

    // Waits until the disk has what was written, and opens the file anew, so that a node sees what others
    // wrote.
    void settle();

    [[nodiscard]] FileIdentity identity() const { return identity_; }
    [[nodiscard]] std::uint64_t size() const;

    // Whether the path still leads to this very file. The system goes on taking what is written to a file that
    // was removed or replaced, and drops it at the end.
    void require_presence() const;

  private:
    void open();
    [[noreturn]] void fail(const char* call, int error) const;

    std::filesystem::path path_;
    int descriptor_ = -1;
    FileIdentity identity_;
};

}  // namespace peterka::hdf5
