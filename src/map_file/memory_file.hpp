// An HDF5 file that lives in memory until it is closed, and then is its bytes.
//
// HDF5 meets no disk that could fail it: 1.10 can't close a file that it couldn't write, and takes the program
// down with it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "hdf5/checked.hpp"
#include "hdf5/hdf5.hpp"

namespace peterka::map_file {

// The bytes of the file that `fill` fills, to the end that it tells: the memory grows in steps.
[[nodiscard]] std::vector<std::byte> bytes_of_file(const hdf5::Checked& check,
                                                   const std::function<std::uint64_t(hid_t)>& fill);

}  // namespace peterka::map_file
