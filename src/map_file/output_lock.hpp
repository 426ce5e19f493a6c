// Keeps a second run out of an output file while a first one writes it, whatever name it uses.
//
// FILE.peterka-lock beside the file is locked while the run lives and removed at its end. The system releases
// the lock of a process that dies, so a lock file left behind by a kill blocks nobody. The file itself is
// locked, too, against access through a link: at an offset that no file reaches, and by a kind of lock that
// neither HDF5 nor MPI-IO uses, so that reading stays possible. For one rank alone. Constructors throw
// Failure(ExitCode::output).
#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <utility>

namespace peterka::map_file {

[[nodiscard]] std::filesystem::path lock_name(const std::filesystem::path& path);

// A file descriptor, closed on destruction.
class Descriptor {
  public:
    explicit Descriptor(int number = -1) : number_(number) {}
    Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
    Descriptor& operator=(Descriptor&& other) noexcept {
        std::swap(number_, other.number_);
        return *this;
    }
    ~Descriptor();
    [[nodiscard]] int number() const { return number_; }
    [[nodiscard]] bool is_open() const { return number_ >= 0; }

  private:
    int number_;
};

class OutputLock {
  public:
    static constexpr std::chrono::seconds default_patience{6};

    // Throws, naming the process, if another run holds it for longer than `patience`: the ranks of a killed run
    // live on for two or three seconds. A file of the lock's name that no run has created is refused.
    explicit OutputLock(const std::filesystem::path& path,
                        std::chrono::milliseconds patience = default_patience);
    OutputLock(OutputLock&& other) noexcept = default;
    OutputLock& operator=(OutputLock&& other) noexcept = default;
    ~OutputLock();

    // Why there is no lock, if the folder cannot be written or the file system supports none; else empty.
    [[nodiscard]] const std::string& lacking() const { return lacking_; }

  private:
    std::filesystem::path name_;
    Descriptor descriptor_;
    std::string lacking_;
};

// The lock on the file itself. None if there is no such file, or it cannot be written.
class FileLock {
  public:
    explicit FileLock(const std::filesystem::path& path,
                      std::chrono::milliseconds patience = OutputLock::default_patience);
    [[nodiscard]] const std::string& lacking() const { return lacking_; }

  private:
    Descriptor descriptor_;
    std::string lacking_;
};

}  // namespace peterka::map_file
