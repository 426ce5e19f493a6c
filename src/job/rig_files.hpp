// `rig = "rigs/170mm.toml"` at the top of a job: the tables of the rig come from a file of their own.
//
// A rig file has any of [hammer], [cart] and [contact], and may itself build on another rig. Its name is
// relative to the file that names it. A key that the job gives takes precedence, also over its alternative
// where only one of two may be given; a [contact] with another law replaces the whole table.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "job/document.hpp"

namespace peterka::job {

// Adds to a job's document what only its rig files give. `files` are the names indexed by Location::file, the
// job's own first; those of rig files are appended. False if one cannot be used.
[[nodiscard]] bool bring_in_rigs(Value& document, const std::filesystem::path& job_file,
                                 std::vector<std::string>& files, std::vector<Fault>& faults);

}  // namespace peterka::job
