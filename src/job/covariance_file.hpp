// `[uncertainty] file = "stop_identified.toml"`: numbers that are uncertain together come from a file of their
// own, as identify.py writes it. It has one table, [covariance], which becomes [uncertainty.covariance].
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "job/document.hpp"

namespace peterka::job {

// Adds to a job's document what the file gives; see bring_in_rigs (rig_files.hpp). False if it can't be used.
[[nodiscard]] bool bring_in_covariance(Value& document, const std::filesystem::path& job_file,
                                       std::vector<std::string>& files, std::vector<Fault>& faults);

// The value of that key; nullptr if there is none.
[[nodiscard]] const Value* named_covariance(const Value& document);

}  // namespace peterka::job
