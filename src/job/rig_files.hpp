// `rig = "rigs/170mm.toml"` at the top of a job: the tables of the rig come from a file of their own.
//
// A rig file has [hammer], [cart] and [contact], each or any of them, and may itself begin from another rig.
// Its name is relative to the file that names it. A key that the job gives wins, and so does one of two keys of
// which only one may be given; a [contact] with another law replaces the whole table.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "job/document.hpp"

namespace peterka::job {

// Puts into the document of a job what its rig files have and it has not. `files` are the names that
// Location::file counts, the job's own first: those of rig files are appended. False where one can't be used.
[[nodiscard]] bool bring_in_rigs(Value& document, const std::filesystem::path& job_file,
                                 std::vector<std::string>& files, std::vector<Fault>& faults);

}  // namespace peterka::job
