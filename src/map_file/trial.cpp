#include "map_file/trial.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "hdf5/disk_file.hpp"
#include "hdf5/hdf5.hpp"
#include "hdf5/storage.hpp"
#include "map_file/layout.hpp"
#include "map_file/make_layout.hpp"
#include "map_file/matches_plan.hpp"
#include "map_file/seal.hpp"
#include "support/errors.hpp"

namespace peterka::map_file {

namespace {

constexpr rlim_t most_seconds = 5;        // of CPU time; all headers and texts take milliseconds
constexpr rlim_t spare_memory = 1 << 28;  // beyond what is in use [bytes]
constexpr int lost_record = 1;

rlim_t address_space() {
    rlim_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    return pages * static_cast<rlim_t>(::sysconf(_SC_PAGESIZE));
}

void limit(__rlimit_resource_t resource, rlim_t amount) {
    rlimit limits{};
    if (::getrlimit(resource, &limits) != 0) return;
    limits.rlim_cur = std::min(amount, limits.rlim_cur);
    static_cast<void>(!::setrlimit(resource, &limits));
}

// Suppresses its core dump, its messages and MPI's report of its end, and limits its time and memory.
void be_quiet_and_small(rlim_t memory) {
    for (const int signal : {SIGSEGV, SIGABRT, SIGBUS, SIGFPE, SIGILL, SIGXCPU}) std::signal(signal, SIG_DFL);
    const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
    if (nowhere >= 0) static_cast<void>(!::dup2(nowhere, STDERR_FILENO));
    limit(RLIMIT_CORE, 0);
    limit(RLIMIT_CPU, most_seconds);
    limit(RLIMIT_AS, memory);
}

// A record at the end that does not begin as one is damaged; another program would have moved it.
bool has_lost_record(const hdf5::Checked& check, hid_t file, const hdf5::DiskFile& disk) {
    if (!is_own_link(file, path::bytes)) return false;
    const hdf5::DatasetId dataset(H5Dopen2(file, path::bytes, H5P_DEFAULT));
    if (dataset.id() < 0) return false;
    const auto storage = hdf5::Storage::of(check, dataset.id());
    return storage && storage->end() == disk.size();
}

// Makes HDF5 read all that it will read of the file: headers, attributes, scales.
int try_to_read(const hdf5::Checked& check) {
    try {
        const hdf5::DiskFile disk(check.path());
        const hdf5::PropertiesId access = file_access(check);
        const hdf5::FileId file(H5Fopen(check.path().c_str(), H5F_ACC_RDONLY, access.id()));
        if (file.id() < 0) return 0;  // the actual opening reports why
        if (has_lost_record(check, file.id(), disk)) return lost_record;
        static_cast<void>(seal_of(check, file.id(), &disk, Sealed::frame));
    } catch (const std::exception&) {  // reported when the file is actually read
    }
    return 0;
}

std::string in_words(int status) {
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return "";
    if (WIFEXITED(status) && WEXITSTATUS(status) == lost_record)
        return "is damaged: the record of its bytes, at its end, is none (wrong checksum)";
    return "is damaged: HDF5 breaks down over it";
}

}  // namespace

std::string fault_in_trial(const hdf5::Checked& check) {
    const rlim_t memory = address_space() + 2 * std::filesystem::file_size(check.path()) + spare_memory;
    const pid_t child = ::fork();
    if (child < 0) {
        return fmt::format(
            "can't be tried by a process of its own, as a file without a checksum over its bytes "
            "is: fork failed: {}",
            std::generic_category().message(errno));
    }
    if (child == 0) {
        be_quiet_and_small(memory);
        ::_exit(try_to_read(check));
    }
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    return in_words(status);
}

}  // namespace peterka::map_file
