// What made a map: program, libraries and arithmetic, determined at run time and stored in the file's root
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
    std::string
        arithmetic;  // map_file/arithmetic.hpp: files made with different ones may differ in the last bits
};

[[nodiscard]] Provenance collect_provenance();

// Version of the library that is loaded, e.g. "7.1.1".
[[nodiscard]] std::string sundials_version();

}  // namespace peterka::map_file
