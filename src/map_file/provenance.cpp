#include "map_file/provenance.hpp"

#include <fmt/format.h>
#include <hdf5.h>
#include <mpi.h>
#include <sundials/sundials_version.h>
#include <Eigen/Core>

#include <array>

#include "map_file/arithmetic.hpp"

// Made by the build (support/version.cmake).
#if __has_include("version.hpp")
#include "version.hpp"
#endif
#ifndef PETERKA_VERSION
#define PETERKA_VERSION "unknown"
#endif
#ifndef PETERKA_GIT_COMMIT
#define PETERKA_GIT_COMMIT "unknown"
#endif

namespace peterka::map_file {

namespace {

std::string hdf5_version() {
    unsigned major = 0;
    unsigned minor = 0;
    unsigned release = 0;
    H5get_libversion(&major, &minor, &release);
    return fmt::format("{}.{}.{}", major, minor, release);
}

// Implementations return a page of text; its first line up to the first comma names them.
std::string mpi_version() {
    std::array<char, MPI_MAX_LIBRARY_VERSION_STRING> text{};
    int length = 0;
    MPI_Get_library_version(text.data(), &length);
    const std::string all(text.data(), static_cast<std::size_t>(length));
    return all.substr(0, all.find_first_of(",\n"));
}

}  // namespace

std::string sundials_version() {
    std::array<char, 32> text{};
    SUNDIALSGetVersion(text.data(), static_cast<int>(text.size()));
    return text.data();
}

Provenance collect_provenance() {
    return {PETERKA_VERSION,
            PETERKA_GIT_COMMIT,
            hdf5_version(),
            mpi_version(),
            sundials_version(),
            fmt::format("{}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION),
            fmt::format("{}.{}.{}", FMT_VERSION / 10000, FMT_VERSION / 100 % 100, FMT_VERSION % 100),
            arithmetic()};
}

}  // namespace peterka::map_file
