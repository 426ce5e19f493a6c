// Keeps a second run out of an output file while a first one writes it, whatever name it comes by.
//
// FILE.peterka-lock beside the file is locked for as long as the run lives and removed at its end. The system
// takes the lock from a process that dies, so that one left behind by a kill stops nobody. The file itself is
// locked, too, so that a link to it is no way in: at a byte that no file reaches, and by a kind of lock that
// neither HDF5 nor MPI-IO uses, so that whoever only reads it may. For one rank alone. Constructors throw
// Failure(ExitCode::output).
#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <utility>

namespace peterka::map_file {

[[nodiscard]] std::filesystem::path lock_name(const std::filesystem::path& path);

// An open file, closed at the end.
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

    // Throws where another run holds it, naming that process, and stays: the ranks of a run that was killed
    // live on for two or three seconds. What lies under the lock's name and was not put there by a run is
    // refused.
    explicit OutputLock(const std::filesystem::path& path,
                        std::chrono::milliseconds patience = default_patience);
    OutputLock(OutputLock&& other) noexcept = default;
    OutputLock& operator=(OutputLock&& other) noexcept = default;
    ~OutputLock();

    // Why there is no lock, where a folder can't be written or a file system knows none; else empty.
    [[nodiscard]] const std::string& lacking() const { return lacking_; }

  private:
    std::filesystem::path name_;
    Descriptor descriptor_;
    std::string lacking_;
};

// The lock on the file itself. None where there is no such file, or it can't be written.
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
