// Where a text may be cut without cutting a letter of UTF-8 in two.
#pragma once

#include <cstddef>
#include <string_view>

namespace peterka {

// Bytes of a text's beginning: the most that are no more than `longest` and end where a letter ends. All bytes
// of a letter but its first are 10xxxxxx.
[[nodiscard]] constexpr std::size_t whole_letters(std::string_view text, std::size_t longest) {
    if (text.size() <= longest) return text.size();
    std::size_t length = longest;
    while (length > 0 && (static_cast<unsigned char>(text[length]) & 0xc0U) == 0x80U) --length;
    return length;
}

}  // namespace peterka
