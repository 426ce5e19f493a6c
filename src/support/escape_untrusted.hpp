// A stranger's text made harmless for the terminal on which it is read: what comes out of a file, a job, a lock
// or a name may hold commands to the terminal, or pretend to be a message of this program.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace peterka {

// As one line: control characters, marks that turn the direction of writing, and bytes that aren't UTF-8 are
// shown as \x1b, \u009b, \xff; what is longer than so many bytes is cut. A text that was made harmless stays as
// it is.
[[nodiscard]] std::string escape_untrusted(std::string_view text, std::size_t longest = 200);

// The same for whole pages, with their line breaks and of any length: everything that is printed goes through
// it.
[[nodiscard]] std::string escape_untrusted_page(std::string_view text);

}  // namespace peterka
