// Calls to HDF5 that cannot fail unnoticed.
//
//     const Checked check(path);
//     const DatasetId dataset(check(H5Dopen2(file, "regime", H5P_DEFAULT), "H5Dopen2"));
//
// A negative result becomes a Failure(ExitCode::output) that names the file, the call and the reason that HDF5
// (or, below it, MPI or the system) gave. Making one turns off HDF5's own printing of its error stack.
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

// To be called before MPI_Init: HDF5 closes nothing by itself when MPI or the program ends. Every file is
// closed where it was written; what is still open then is a file whose MPI file alone was closed
// (map_file/parallel_file.cpp), or one that couldn't be written, and HDF5 1.10 crashes when it closes one. It
// doesn't print its error stacks from here on either.
void leave_open_files_alone();

// Why the last HDF5 call failed, in the words of the lowest layer that said something.
[[nodiscard]] std::string hdf5_reason();

}  // namespace peterka::hdf5
