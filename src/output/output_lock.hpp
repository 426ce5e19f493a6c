// Keeps a second run out of an output file while a first one writes it.
//
// FILE.lock beside the file is locked for as long as the run lives and removed at its end. The system takes the
// lock from a process that dies, so that a FILE.lock left behind by a kill stops nobody. Where a folder can't
// be written or a file system knows no locks there is no protection, and no error.
#pragma once

#include <chrono>
#include <filesystem>

namespace peterka::output {

[[nodiscard]] std::filesystem::path lock_name(const std::filesystem::path& path);

class OutputLock {
  public:
    static constexpr std::chrono::seconds default_patience{6};

    // For one rank alone. Throws Failure(ExitCode::output), naming the other process, where the file stays
    // locked: the ranks of a run that was killed live on for two or three seconds.
    explicit OutputLock(const std::filesystem::path& path,
                        std::chrono::milliseconds patience = default_patience);
    OutputLock(OutputLock&& other) noexcept;
    OutputLock& operator=(OutputLock&& other) noexcept;
    ~OutputLock();

  private:
    std::filesystem::path name_;
    int descriptor_ = -1;  // -1: not locked
};

}  // namespace peterka::output
