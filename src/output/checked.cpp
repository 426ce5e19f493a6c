#include "output/checked.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <hdf5.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <string_view>
#include <system_error>
#include <utility>

#include "support/errors.hpp"

namespace peterka::output {

namespace {

herr_t keep_first(unsigned depth, const H5E_error2_t* error, void* text) {
    if (depth == 0 && error->desc != nullptr) *static_cast<std::string*>(text) = error->desc;
    return 0;
}

// The POSIX driver reports one long line of times, addresses and sizes; the system's own text is quoted inside
// it.
std::string system_text(const std::string& reason) {
    constexpr std::string_view key = "error message = '";
    const auto found = reason.find(key);
    if (found == std::string::npos) return reason;
    const auto begin = found + key.size();
    return reason.substr(begin, reason.find('\'', begin) - begin);
}

// Why a file can't be written, in the system's words; HDF5 1.10 and MPI-IO don't pass them on. Asking for the
// room that the file has already fails where a write does, and changes nothing else.
std::string why_unwritable(const std::filesystem::path& path) {
    const int descriptor = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
    int error = errno;
    if (descriptor >= 0) {
        // not posix_fallocate, which writes zeros of its own where the file system has no such call
        error = ::fallocate(descriptor, 0, 0, ::lseek(descriptor, 0, SEEK_END)) == 0 ? 0 : errno;
        ::close(descriptor);
    }
    if (error == 0 || error == EINVAL || error == EOPNOTSUPP) return "";
    return fmt::format(" ({})", std::generic_category().message(error));
}

}  // namespace

std::string hdf5_reason() {
    std::string reason;
    H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, keep_first, &reason);
    std::ranges::replace(reason, '\n', ' ');  // MPICH's are of several lines
    return reason.empty() ? "no reason given" : system_text(reason);
}

Checked::Checked(std::filesystem::path path) : path_(std::move(path)) {
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

void Checked::fail(const char* call) const {
    const std::string reason = hdf5_reason();
    const std::string why = call == std::string_view("H5Dwrite") ? why_unwritable(path_) : "";
    throw Failure(ExitCode::output, fmt::format("{}: {} failed: {}{}.", path_.string(), call, reason, why));
}

}  // namespace peterka::output
