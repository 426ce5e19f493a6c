// An HDF5 file that is built in memory and yields its bytes on closing.
//
// This keeps disk errors away from HDF5: version 1.10 cannot close a file that it could not write, and crashes
// the program.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "hdf5/checked.hpp"
#include "hdf5/hdf5.hpp"

namespace peterka::map_file {

// The bytes of the file that `fill` fills, up to the end that it returns: the memory grows in steps.
[[nodiscard]] std::vector<std::byte> bytes_of_file(const hdf5::Checked& check,
                                                   const std::function<std::uint64_t(hid_t)>& fill);

}  // namespace peterka::map_file
