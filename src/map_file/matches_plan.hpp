// Whether the objects of an existing file are what the layout says, and its own.
//
// A file may come from anybody. A link that leads out of it, storage in another file, a virtual dataset, or two
// names for one object would make a run write where nobody asked it to, so none is followed: every object is
// there under a plain link, no two are alike, and every dataset of its type, size and chunks has storage of its
// own inside the file.
#pragma once

#include <hdf5.h>

#include <optional>
#include <string>

#include "hdf5/checked.hpp"
#include "map_file/layout.hpp"

namespace peterka::map_file {

// Whether every part of a path is a plain link of this file. There may be nothing of that name.
[[nodiscard]] bool is_own_link(hid_t file, const std::string& path);

// What is wrong with the first dataset that is not as the job's layout says; nothing where all are.
[[nodiscard]] std::optional<std::string> layout_fault(const hdf5::Checked& check, hid_t file,
                                                      const job::Job& job);

}  // namespace peterka::map_file
