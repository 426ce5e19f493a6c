// Calls to HDF5 that cannot fail unnoticed.
//
//     const Checked check(path);
//     const DatasetId dataset(check(H5Dopen2(file, "regime", H5P_DEFAULT), "H5Dopen2"));
//
// A negative result becomes a Failure(ExitCode::output) that names the file, the call and the reason that HDF5
// (or, below it, MPI or the system) gave. Constructing one turns off HDF5's printing of its error stack.
#pragma once

#include <concepts>
#include <filesystem>
#include <string>

namespace peterka::hdf5 {

class Checked {
  public:
    explicit Checked(std::filesystem::path path);

    template <std::signed_integral Result>
    Result operator()(Result result, const char* call) const {
        if (result < 0) fail(call);
        return result;
    }
    [[noreturn]] void fail(const char* call) const;

    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

// Call before MPI_Init: HDF5 then closes nothing by itself when MPI or the program ends. Every file is closed
// where it was written; a file still open at the end is one of which only the MPI file was closed
// (map_file/parallel_file.cpp), or one that couldn't be written, and HDF5 1.10 crashes when it closes such a
// file. From here on HDF5 prints no error stacks either.
void leave_open_files_alone();

// Why the last HDF5 call failed, as reported by the lowest layer that gave a reason.
[[nodiscard]] std::string hdf5_reason();

}  // namespace peterka::hdf5
