// What lies in a folder. std::filesystem's iterators end the program where they find no memory (libstdc++ 12 to
// 14).
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace peterka {

// Names of the entries but "." and "..", in no particular order; none of a folder that cannot be read.
[[nodiscard]] std::vector<std::string> names_in(const std::filesystem::path& folder);

}  // namespace peterka
