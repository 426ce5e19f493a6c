// `--set table.key=value`: values given on the command line in place of those of the file.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "job/document.hpp"

namespace peterka::job {

// Sets each override in the document, later ones over earlier ones. An override that cannot be understood is a
// fault.
void apply_overrides(Value& document, std::span<const std::string> overrides, std::vector<Fault>& faults);

}  // namespace peterka::job
