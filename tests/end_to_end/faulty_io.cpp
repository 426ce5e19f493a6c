// A library to be loaded before all others (LD_PRELOAD): one call to the system fails, as on a failing or full
// disk.
//
// * FAULTY_CALL: write, read, fsync, truncate, allocate, rename, unlink or lock: which kind
// * FAULTY_AT: its number, from 1, among the calls of this kind that concern FAULTY_PATH
// * FAULTY_HOW: ENOSPC, EIO, EDQUOT, EINTR; "short": half of the bytes; "persistent ENOSPC", ...: from there on
// * FAULTY_PATH: part of the path of the files
// * FAULTY_COUNT: a file to which the number of these calls is written at the end, if there were any
// * FAULTY_RECORD: a file to which a line is added for each call that concerns FAULTY_PATH: its kind and the
// path
// * FAULTY_RANK: of the MPI ranks this one alone
//
// Nothing else changes. Calls of a kind are counted under all their names.
#include <dlfcn.h>
#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <string>

namespace {

template <class Function>
Function next(const char* name) {
    return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

// Read once, when the library is loaded: threads of MPI write and read, too, while it sets variables.
struct Settings {
    static std::string value(const char* name) {
        const char* const value = std::getenv(name);
        return value == nullptr ? "" : value;
    }
    static int error(const std::string& name) {
        static const std::map<std::string, int> errors{
            {"ENOSPC", ENOSPC}, {"EIO", EIO}, {"EDQUOT", EDQUOT}, {"EINTR", EINTR}};
        return name.empty() || name == "short" ? 0 : errors.at(name);
    }

    std::string call = value("FAULTY_CALL");
    long at = std::atol(value("FAULTY_AT").c_str());
    std::string how = value("FAULTY_HOW");
    bool lasts = how.starts_with("persistent ");
    int error_number = error(lasts ? how.substr(how.find(' ') + 1) : how);  // 0: the call is short
    std::string path = value("FAULTY_PATH");
    std::string count = value("FAULTY_COUNT");
    std::string record = value("FAULTY_RECORD");
    bool mine = value("FAULTY_RANK").empty() || value("FAULTY_RANK") == value("OMPI_COMM_WORLD_RANK");
};

class Faults {
  public:
    enum class Verdict { sound, fails, is_short };

    [[nodiscard]] bool concern(const char* path) const {
        const bool does = set_.mine && path != nullptr && !set_.path.empty() &&
                          std::strstr(path, set_.path.c_str()) != nullptr;
        if (does) last_path = path;
        return does;
    }
    [[nodiscard]] bool concern(int descriptor) const {
        if (!set_.mine || set_.path.empty()) return false;
        const int before = errno;
        std::array<char, 64> link{};
        std::array<char, PATH_MAX> path{};
        std::snprintf(link.data(), link.size(), "/proc/self/fd/%d", descriptor);
        const ssize_t length = readlink(link.data(), path.data(), path.size() - 1);
        errno = before;
        return length > 0 && concern(path.data());
    }
    // Sets errno where the call fails.
    Verdict judge(const char* call, bool concerned) {
        if (concerned) record(call);
        if (!concerned || call != set_.call) return Verdict::sound;
        ++calls_;
        if (set_.at == 0 || (set_.lasts ? calls_ < set_.at : calls_ != set_.at)) return Verdict::sound;
        if (set_.error_number == 0) return Verdict::is_short;
        errno = set_.error_number;
        return Verdict::fails;
    }
    void report() const {
        if (set_.count.empty() || calls_ == 0) return;  // so does what MPI starts beside the program
        if (std::FILE* file = std::fopen(set_.count.c_str(), "w")) {
            std::fprintf(file, "%ld\n", calls_.load());
            std::fclose(file);
        }
    }

  private:
    void record(const char* call) const {
        if (set_.record.empty()) return;
        const int before = errno;
        if (std::FILE* file = std::fopen(set_.record.c_str(), "a")) {
            std::fprintf(file, "%s %s\n", call, last_path.c_str());
            std::fclose(file);
        }
        errno = before;
    }

    static inline thread_local std::string last_path;  // that was asked about
    Settings set_;
    std::atomic<long> calls_ = 0;
};

// Never destroyed: threads go on to the end.
Faults& faults() {
    static Faults& all = *new Faults;
    return all;
}
const struct FromLoadToExit {
    FromLoadToExit() { faults(); }
    ~FromLoadToExit() { faults().report(); }
} from_load_to_exit;

using Verdict = Faults::Verdict;

template <class Function>
ssize_t transfer(const char* call, int descriptor, size_t size, Function&& go_on) {
    switch (faults().judge(call, faults().concern(descriptor))) {
        case Verdict::fails:
            return -1;
        case Verdict::is_short:
            return go_on(size / 2);
        case Verdict::sound:
            break;
    }
    return go_on(size);
}

template <class Function>
int plain(const char* call, bool concerned, Function&& go_on) {
    return faults().judge(call, concerned) == Verdict::fails ? -1 : go_on();
}

}  // namespace

extern "C" {

ssize_t write(int fd, const void* data, size_t size) {
    static const auto real = next<ssize_t (*)(int, const void*, size_t)>("write");
    return transfer("write", fd, size, [&](size_t some) { return real(fd, data, some); });
}
ssize_t pwrite(int fd, const void* data, size_t size, off_t at) {
    static const auto real = next<ssize_t (*)(int, const void*, size_t, off_t)>("pwrite");
    return transfer("write", fd, size, [&](size_t some) { return real(fd, data, some, at); });
}
ssize_t pwrite64(int fd, const void* data, size_t size, off64_t at) {
    static const auto real = next<ssize_t (*)(int, const void*, size_t, off64_t)>("pwrite64");
    return transfer("write", fd, size, [&](size_t some) { return real(fd, data, some, at); });
}
ssize_t read(int fd, void* data, size_t size) {
    static const auto real = next<ssize_t (*)(int, void*, size_t)>("read");
    return transfer("read", fd, size, [&](size_t some) { return real(fd, data, some); });
}
ssize_t pread(int fd, void* data, size_t size, off_t at) {
    static const auto real = next<ssize_t (*)(int, void*, size_t, off_t)>("pread");
    return transfer("read", fd, size, [&](size_t some) { return real(fd, data, some, at); });
}
ssize_t pread64(int fd, void* data, size_t size, off64_t at) {
    static const auto real = next<ssize_t (*)(int, void*, size_t, off64_t)>("pread64");
    return transfer("read", fd, size, [&](size_t some) { return real(fd, data, some, at); });
}
int fsync(int fd) {
    static const auto real = next<int (*)(int)>("fsync");
    return plain("fsync", faults().concern(fd), [&] { return real(fd); });
}
int ftruncate(int fd, off_t size) {
    static const auto real = next<int (*)(int, off_t)>("ftruncate");
    return plain("truncate", faults().concern(fd), [&] { return real(fd, size); });
}
int ftruncate64(int fd, off64_t size) {
    static const auto real = next<int (*)(int, off64_t)>("ftruncate64");
    return plain("truncate", faults().concern(fd), [&] { return real(fd, size); });
}
int posix_fallocate(int fd, off_t from, off_t size) {
    static const auto real = next<int (*)(int, off_t, off_t)>("posix_fallocate");
    const bool fails = plain("allocate", faults().concern(fd), [] { return 0; }) != 0;
    return fails ? errno : real(fd, from, size);
}
int posix_fallocate64(int fd, off64_t from, off64_t size) {
    static const auto real = next<int (*)(int, off64_t, off64_t)>("posix_fallocate64");
    const bool fails = plain("allocate", faults().concern(fd), [] { return 0; }) != 0;
    return fails ? errno : real(fd, from, size);
}
// under another name here, for fcntl.h has a struct of this one
int lock_file(int fd, int operation) __asm__("flock");
int lock_file(int fd, int operation) {
    static const auto real = next<int (*)(int, int)>("flock");
    return plain("lock", faults().concern(fd), [&] { return real(fd, operation); });
}
int rename(const char* from, const char* to) {
    static const auto real = next<int (*)(const char*, const char*)>("rename");
    return plain("rename", faults().concern(from), [&] { return real(from, to); });
}
int unlink(const char* path) {
    static const auto real = next<int (*)(const char*)>("unlink");
    return plain("unlink", faults().concern(path), [&] { return real(path); });
}
}
