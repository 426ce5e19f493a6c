// Where a text may be cut without splitting a UTF-8 character.
#pragma once

#include <cstddef>
#include <string_view>

namespace peterka {

// Length of the longest prefix of at most `longest` bytes that ends where a character ends. All bytes of a
// character but its first are 10xxxxxx.
[[nodiscard]] constexpr std::size_t whole_letters(std::string_view text, std::size_t longest) {
    if (text.size() <= longest) return text.size();
    std::size_t length = longest;
    while (length > 0 && (static_cast<unsigned char>(text[length]) & 0xc0U) == 0x80U) --length;
    return length;
}

}  // namespace peterka
