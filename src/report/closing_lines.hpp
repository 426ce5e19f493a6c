// The last lines of what a run tells: the file that holds its results, and the command that draws it.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace peterka {

// "Map file   a.h5\nDraw it    postprocess/draw.py a.h5\n"; with the installed peterka-draw if this program is
// installed beside it.
[[nodiscard]] std::string closing_lines(std::string_view what, const std::filesystem::path& file);

}  // namespace peterka
