// Opens a file without a checksum over its raw bytes first in a separate process, which HDF5 may crash or hang.
#pragma once

#include <string>

#include "hdf5/checked.hpp"

namespace peterka::map_file {

// Why this process must not open the file, as in "FILE: is damaged: ..."; empty if it may.
[[nodiscard]] std::string fault_in_trial(const hdf5::Checked& check);

}  // namespace peterka::map_file
