#include "support/folder.hpp"

#include <dirent.h>

#include <memory>
#include <utility>

namespace peterka {

std::vector<std::string> names_in(const std::filesystem::path& folder) {
    std::vector<std::string> names;
    const auto close = [](DIR* open) { ::closedir(open); };
    const std::unique_ptr<DIR, decltype(close)> open(::opendir(folder.c_str()), close);
    if (!open) return names;
    while (const dirent* entry = ::readdir(open.get())) {
        std::string name = entry->d_name;
        if (name != "." && name != "..") names.push_back(std::move(name));
    }
    return names;
}

}  // namespace peterka
