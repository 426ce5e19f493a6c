#include "map_file/output_lock.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <string>
#include <string_view>
#include <system_error>
#include <thread>
#include <utility>

#include "support/errors.hpp"
#include "support/escape_untrusted.hpp"

namespace peterka::map_file {

namespace {

// The run that held the lock may have removed the file between our opening and locking it.
bool is_still_there(int descriptor, const std::filesystem::path& name) {
    struct stat opened {};
    struct stat named {};
    return ::fstat(descriptor, &opened) == 0 && ::lstat(name.c_str(), &named) == 0 &&
           opened.st_ino == named.st_ino && opened.st_dev == named.st_dev;
}

// How a lock file begins, so that nothing else is mistaken for one.
constexpr std::string_view mark = "peterka runs as ";

std::string holder(int descriptor) {
    std::array<char, 256> text{};
    const auto length = ::pread(descriptor, text.data(), text.size(), 0);
    const std::string_view all(text.data(), length > 0 ? static_cast<std::size_t>(length) : 0);
    return all.starts_with(mark) ? escape_untrusted(all.substr(mark.size())) : "another process";
}

// Whether the open file can be a lock that a run has made: a file without other names, empty or marked.
bool is_lock(int descriptor) {
    struct stat status {};
    if (::fstat(descriptor, &status) != 0 || !S_ISREG(status.st_mode) || status.st_nlink > 1) return false;
    std::array<char, mark.size()> begin{};
    const auto length = ::pread(descriptor, begin.data(), begin.size(), 0);
    if (length < 0) return true;  // it can't be told, and nothing is taken from it
    return mark.starts_with(std::string_view(begin.data(), static_cast<std::size_t>(length)));
}

void sign(int descriptor) {
    std::array<char, 128> host{};
    static_cast<void>(::gethostname(host.data(), host.size() - 1));
    const std::string text = fmt::format("{}process {} on {}", mark, ::getpid(), host.data());
    // only a convenience for readers
    if (::ftruncate(descriptor, 0) == 0) static_cast<void>(!::pwrite(descriptor, text.data(), text.size(), 0));
}

std::string no_lock(const std::filesystem::path& path, int error) {
    return fmt::format("{} can't be locked ({}): nothing keeps a second run from it", path.string(),
                       std::generic_category().message(error));
}

[[noreturn]] void refuse_entry(const std::filesystem::path& path, const std::string& who) {
    throw Failure(ExitCode::output,
                  fmt::format("{}: is being written by another run ({}). Wait for its end, or choose another "
                              "name with --output.",
                              path.string(), who));
}

constexpr std::chrono::milliseconds between_looks{50};

// Waits for the next attempt; false once patience is exhausted.
bool waits(std::chrono::milliseconds& patience) {
    if (patience.count() <= 0) return false;
    patience -= between_looks;
    std::this_thread::sleep_for(between_looks);
    return true;
}

}  // namespace

Descriptor::~Descriptor() {
    if (number_ >= 0) ::close(number_);
}

std::filesystem::path lock_name(const std::filesystem::path& path) {
    return std::filesystem::path(path) += ".peterka-lock";
}

OutputLock::OutputLock(const std::filesystem::path& path, std::chrono::milliseconds patience)
    : name_(lock_name(path)) {
    for (;;) {
        Descriptor opened(::open(name_.c_str(), O_RDWR | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, 0666));
        const int error = errno;
        const bool is_other_thing = error == ELOOP || error == EISDIR || error == ENXIO;
        if (opened.is_open() ? !is_lock(opened.number()) : is_other_thing) {
            throw Failure(ExitCode::output,
                          fmt::format("{}: is no lock of peterka, but would have to be one. Move it "
                                      "away, or choose another name with --output.",
                                      name_.string()));
        }
        if (!opened.is_open()) {
            if (error != ENOENT) lacking_ = no_lock(path, error);  // without a folder nothing will be written
            return;
        }
        if (::flock(opened.number(), LOCK_EX | LOCK_NB) != 0) {
            if (errno != EWOULDBLOCK) {
                lacking_ = no_lock(path, errno);
                return;
            }
            if (!waits(patience)) refuse_entry(path, holder(opened.number()));
        } else if (is_still_there(opened.number(), name_)) {
            sign(opened.number());
            descriptor_ = std::move(opened);
            return;
        }
    }
}

OutputLock::~OutputLock() {
    if (descriptor_.is_open() && is_still_there(descriptor_.number(), name_)) ::unlink(name_.c_str());
}

FileLock::FileLock(const std::filesystem::path& path, std::chrono::milliseconds patience)
    : descriptor_(::open(path.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC)) {
    struct stat status {};
    if (!descriptor_.is_open() || ::fstat(descriptor_.number(), &status) != 0 || !S_ISREG(status.st_mode))
        return;
    for (;;) {
        struct flock range {};
        range.l_type = F_WRLCK;
        range.l_whence = SEEK_SET;
        range.l_start = off_t{1} << 62;
        range.l_len = 1;
        if (::fcntl(descriptor_.number(), F_OFD_SETLK, &range) == 0) return;
        if (errno != EAGAIN && errno != EACCES) {
            lacking_ = no_lock(path, errno);
            return;
        }
        if (!waits(patience)) refuse_entry(path, "it came by another name");
    }
}

}  // namespace peterka::map_file
