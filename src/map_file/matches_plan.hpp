// Whether the objects of an existing file match the layout and belong to the file itself.
//
// A file may come from an untrusted source. A link that leads out of it, storage in another file, a virtual
// dataset, or two names for one object would make a run write to unintended places, so none is followed: every
// object must be under a hard link, no two may be the same, and every dataset must have the planned type, size
// and chunks, and storage of its own inside the file.
#pragma once

#include <hdf5.h>

#include <optional>
#include <string>

#include "hdf5/checked.hpp"
#include "map_file/layout.hpp"

namespace peterka::map_file {

// Whether every part of a path is a hard link of this file; false if there is nothing of that name.
[[nodiscard]] bool is_own_link(hid_t file, const std::string& path);

// What is wrong with the first dataset that deviates from the job's layout; nothing if none does.
[[nodiscard]] std::optional<std::string> layout_fault(const hdf5::Checked& check, hid_t file,
                                                      const job::Job& job);

}  // namespace peterka::map_file
