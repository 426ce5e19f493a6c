#include "output/output_lock.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <string>
#include <thread>
#include <utility>

#include "support/errors.hpp"
#include "support/harmless.hpp"

namespace peterka::output {

namespace {

// The run that held the lock may have removed the file between our opening and locking it.
bool is_still_there(int descriptor, const std::filesystem::path& name) {
    struct stat opened {};
    struct stat named {};
    return ::fstat(descriptor, &opened) == 0 && ::stat(name.c_str(), &named) == 0 &&
           opened.st_ino == named.st_ino && opened.st_dev == named.st_dev;
}

std::string holder(int descriptor) {
    std::array<char, 256> text{};
    const auto length = ::pread(descriptor, text.data(), text.size(), 0);
    return length > 0 ? harmless({text.data(), static_cast<std::size_t>(length)}) : "another process";
}

void sign(int descriptor) {
    std::array<char, 128> host{};
    static_cast<void>(::gethostname(host.data(), host.size() - 1));
    const std::string text = fmt::format("process {} on {}", ::getpid(), host.data());
    // only a convenience for who reads it
    if (::ftruncate(descriptor, 0) == 0) static_cast<void>(!::pwrite(descriptor, text.data(), text.size(), 0));
}

}  // namespace

std::filesystem::path lock_name(const std::filesystem::path& path) {
    return std::filesystem::path(path) += ".lock";
}

OutputLock::OutputLock(const std::filesystem::path& path, std::chrono::milliseconds patience)
    : name_(lock_name(path)) {
    constexpr std::chrono::milliseconds between_looks{50};
    for (;; patience -= between_looks) {
        const int descriptor = ::open(name_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
        if (descriptor < 0) return;
        if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
            const bool taken = errno == EWOULDBLOCK;
            const std::string who = taken ? holder(descriptor) : "";
            ::close(descriptor);
            if (!taken) return;
            if (patience.count() > 0) {
                std::this_thread::sleep_for(between_looks);
                continue;
            }
            throw Failure(
                ExitCode::output,
                fmt::format("{}: is being written by another run ({}). Wait for its end, or choose another "
                            "name with --output.",
                            path.string(), who));
        }
        if (is_still_there(descriptor, name_)) {
            sign(descriptor);
            descriptor_ = descriptor;
            return;
        }
        ::close(descriptor);
    }
}

OutputLock::OutputLock(OutputLock&& other) noexcept
    : name_(std::move(other.name_)), descriptor_(std::exchange(other.descriptor_, -1)) {}

OutputLock& OutputLock::operator=(OutputLock&& other) noexcept {
    std::swap(name_, other.name_);
    std::swap(descriptor_, other.descriptor_);
    return *this;
}

OutputLock::~OutputLock() {
    if (descriptor_ < 0) return;
    ::unlink(name_.c_str());
    ::close(descriptor_);
}

}  // namespace peterka::output
