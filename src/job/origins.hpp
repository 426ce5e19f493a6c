// Where each value of a job was given: a line of the job, a rig file, an override, or nowhere.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "job/document.hpp"

namespace peterka::job {

// Keyed by the full name of a key, e.g. "hammer.mass_kg": "line 7", "rigs/170mm.toml:3", "--set 1". An absent
// key has its default.
using Origins = std::map<std::string, std::string, std::less<>>;

[[nodiscard]] Origins origins_of(const Value& document, const std::vector<std::string>& files);

}  // namespace peterka::job
