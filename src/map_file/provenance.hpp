// What made a map: program, libraries and arithmetic, found out at run time and stored in the file's root
// attributes.
#pragma once

#include <string>

namespace peterka::map_file {

struct Provenance {
    std::string program_version;
    std::string git_commit;
    std::string hdf5;
    std::string mpi;
    std::string sundials;
    std::string eigen;
    std::string fmt;
    std::string arithmetic;  // the instruction path: files made with different ones may differ in the last bits
};

[[nodiscard]] Provenance collect_provenance();

// The arithmetic this process computes with, e.g. "x86-64 scalar double, glibc 2.36, fma".
[[nodiscard]] std::string arithmetic();

}  // namespace peterka::map_file
