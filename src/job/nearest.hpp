// "Did you mean ...": the known word nearest to a misspelt one.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

namespace peterka::job {

// Insertions, deletions and replacements that turn one word into the other (Levenshtein 1966).
[[nodiscard]] std::size_t edit_distance(std::string_view a, std::string_view b);

// The known word nearest to `word`, or an empty one if none is near enough.
[[nodiscard]] std::string_view nearest(std::string_view word, const std::vector<std::string_view>& known);

}  // namespace peterka::job
