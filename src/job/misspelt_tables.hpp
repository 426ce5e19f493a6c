// Tables under a misspelt name, read as what they are meant to be, so that faults inside are told with the
// name's.
#pragma once

#include <string_view>
#include <vector>

#include "job/document.hpp"
#include "job/faults.hpp"

namespace peterka::job {

// Whether a word is another with a letter too much, too few, wrong or swapped with the next; two such in a long
// word. Nearer than what is suggested (nearest.hpp), since what is inside is taken at its word.
[[nodiscard]] bool is_misspelt(std::string_view word, std::string_view meant);

// Renames the tables that these faults call misspelt. Where one with the right name is there as well, it gets
// the keys that it lacks. Returns the faults of those.
[[nodiscard]] std::vector<Fault> rename_misspelt_tables(Value& document, const std::vector<Fault>& faults);

}  // namespace peterka::job
