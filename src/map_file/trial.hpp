// Opens a file that has no checksum over its raw bytes in a process of its own first, which HDF5 may crash or
// keep for ever.
#pragma once

#include <string>

#include "hdf5/checked.hpp"

namespace peterka::map_file {

// Why this process must not open the file, as in "FILE: is damaged: ..."; empty where it may.
[[nodiscard]] std::string fault_in_trial(const hdf5::Checked& check);

}  // namespace peterka::map_file
