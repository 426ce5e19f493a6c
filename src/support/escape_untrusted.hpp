// Makes untrusted text safe to show on a terminal: text from a file, a job, a lock or a name may contain
// terminal commands, or imitate a message of this program.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace peterka {

// As one line: control characters, direction marks, and bytes that are not UTF-8 are shown as \x1b, \u009b,
// \xff; text longer than `longest` bytes is cut. Text that is already safe stays as it is.
[[nodiscard]] std::string escape_untrusted(std::string_view text, std::size_t longest = 200);

// The same for whole pages, keeping line breaks and of any length: everything that is printed passes through
// it.
[[nodiscard]] std::string escape_untrusted_page(std::string_view text);

}  // namespace peterka
