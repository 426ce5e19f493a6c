// A library to be loaded before all others (LD_PRELOAD): one call to the system fails, as on a failing or full
// disk.
//
// * FAULTY_CALL: write, read, fsync, truncate, allocate, rename, unlink or lock: which kind
// * FAULTY_AT: its number, from 1, among the calls of this kind that concern FAULTY_PATH
// * FAULTY_HOW: ENOSPC, EIO, EDQUOT, EINTR; "short": half of the bytes; "persistent ENOSPC", ...: from there on
// * FAULTY_PATH: part of the path of the files
// * FAULTY_COUNT: a file to which the number of these calls is written at the end, if there were any
// * FAULTY_RANK: of the MPI ranks this one alone
//
// Nothing else changes. Calls of a kind are counted under all their names.
#include <dlfcn.h>
#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <climits>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <string>

namespace {

const char* setting(const char* name) {
    const char* const value = std::getenv(name);
    return value == nullptr ? "" : value;
}

template <class Function>
Function next(const char* name) {
    return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

bool concerns(const char* path) {
    const char* const wanted = setting("FAULTY_PATH");
    return path != nullptr && *wanted != '\0' && std::strstr(path, wanted) != nullptr;
}

bool concerns(int descriptor) {
    std::array<char, 64> link{};
    std::array<char, PATH_MAX> path{};
    std::snprintf(link.data(), link.size(), "/proc/self/fd/%d", descriptor);
    return readlink(link.data(), path.data(), path.size() - 1) > 0 && concerns(path.data());
}

class Faults {
  public:
    enum class Verdict { sound, fails, is_short };

    Verdict judge(const char* call, bool concerned) {
        const int before = errno;
        const Verdict verdict =
            concerned && mine() && call == std::string(setting("FAULTY_CALL")) ? count() : Verdict::sound;
        if (verdict != Verdict::fails) errno = before;
        return verdict;
    }
    ~Faults() {
        const char* const report = setting("FAULTY_COUNT");
        if (*report == '\0' || !mine() || calls_ == 0) return;  // so does what MPI starts beside the program
        if (std::FILE* file = std::fopen(report, "w")) {
            std::fprintf(file, "%ld\n", calls_);
            std::fclose(file);
        }
    }

  private:
    static bool mine() {
        const char* const rank = setting("FAULTY_RANK");
        return *rank == '\0' || std::strcmp(rank, setting("OMPI_COMM_WORLD_RANK")) == 0;
    }
    Verdict count() {
        ++calls_;
        std::string how = setting("FAULTY_HOW");
        const std::string persistent = "persistent ";
        const bool lasts = how.rfind(persistent, 0) == 0;
        if (lasts) how = how.substr(persistent.size());
        const long at = std::atol(setting("FAULTY_AT"));
        if (at == 0 || (lasts ? calls_ < at : calls_ != at)) return Verdict::sound;
        if (how == "short") return Verdict::is_short;
        static const std::map<std::string, int> errors{
            {"ENOSPC", ENOSPC}, {"EIO", EIO}, {"EDQUOT", EDQUOT}, {"EINTR", EINTR}};
        errno = errors.at(how);
        return Verdict::fails;
    }
    long calls_ = 0;
};

Faults& faults() {
    static Faults all;
    return all;
}

using Verdict = Faults::Verdict;

template <class Function>
ssize_t transfer(const char* call, int descriptor, size_t size, Function&& go_on) {
    switch (faults().judge(call, concerns(descriptor))) {
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
    return plain("fsync", concerns(fd), [&] { return real(fd); });
}
int ftruncate(int fd, off_t size) {
    static const auto real = next<int (*)(int, off_t)>("ftruncate");
    return plain("truncate", concerns(fd), [&] { return real(fd, size); });
}
int ftruncate64(int fd, off64_t size) {
    static const auto real = next<int (*)(int, off64_t)>("ftruncate64");
    return plain("truncate", concerns(fd), [&] { return real(fd, size); });
}
int posix_fallocate(int fd, off_t from, off_t size) {
    static const auto real = next<int (*)(int, off_t, off_t)>("posix_fallocate");
    const bool fails = plain("allocate", concerns(fd), [] { return 0; }) != 0;
    return fails ? errno : real(fd, from, size);
}
int posix_fallocate64(int fd, off64_t from, off64_t size) {
    static const auto real = next<int (*)(int, off64_t, off64_t)>("posix_fallocate64");
    const bool fails = plain("allocate", concerns(fd), [] { return 0; }) != 0;
    return fails ? errno : real(fd, from, size);
}
// under another name here, for fcntl.h has a struct of this one
int lock_file(int fd, int operation) __asm__("flock");
int lock_file(int fd, int operation) {
    static const auto real = next<int (*)(int, int)>("flock");
    return plain("lock", concerns(fd), [&] { return real(fd, operation); });
}
int rename(const char* from, const char* to) {
    static const auto real = next<int (*)(const char*, const char*)>("rename");
    return plain("rename", concerns(from), [&] { return real(from, to); });
}
int unlink(const char* path) {
    static const auto real = next<int (*)(const char*)>("unlink");
    return plain("unlink", concerns(path), [&] { return real(path); });
}
}
