#include "hdf5/checked.hpp"

#include <fmt/format.h>
#include <hdf5.h>

#include <algorithm>
#include <string_view>
#include <utility>

#include "support/errors.hpp"

namespace peterka::hdf5 {

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

}  // namespace

void leave_open_files_alone() {
    H5dont_atexit();
    H5open();  // once MPI is initialized, this call would make MPI_Finalize close its files
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

std::string hdf5_reason() {
    std::string reason;
    H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, keep_first, &reason);
    std::ranges::replace(reason, '\n', ' ');  // MPICH's reasons span several lines
    return reason.empty() ? "no reason given" : system_text(reason);
}

Checked::Checked(std::filesystem::path path) : path_(std::move(path)) {
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

void Checked::fail(const char* call) const {
    throw Failure(ExitCode::output, fmt::format("{}: {} failed: {}.", path_.string(), call, hdf5_reason()));
}

}  // namespace peterka::hdf5
