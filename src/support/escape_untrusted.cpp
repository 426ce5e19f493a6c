#include "support/escape_untrusted.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <optional>

namespace peterka {
namespace {

struct Letter {
    std::uint32_t code;
    std::size_t bytes;
};

// The UTF-8 character with which a text begins, in its shortest encoding; none if there is none.
std::optional<Letter> first_letter(std::string_view text) {
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
    const unsigned first = byte(0);
    if (first < 0x80) return Letter{first, 1};
    const std::size_t bytes = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
    if (first < 0xc2 || first > 0xf4 || text.size() < bytes) return std::nullopt;
    std::uint32_t code = first & (0x7fU >> bytes);
    for (std::size_t i = 1; i < bytes; ++i) {
        if ((byte(i) & 0xc0U) != 0x80) return std::nullopt;
        code = code << 6U | (byte(i) & 0x3fU);
    }
    const bool is_too_long = (bytes == 3 && code < 0x800) || (bytes == 4 && code < 0x10000);
    const bool is_half_a_pair = code >= 0xd800 && code <= 0xdfff;
    if (is_too_long || is_half_a_pair || code > 0x10ffff) return std::nullopt;
    return Letter{code, bytes};
}

// Whether it acts on the output instead of being shown: controls, direction marks, breaks, invisible
// characters.
bool is_command(std::uint32_t code) {
    struct CodePoints {
        std::uint32_t first;
        std::uint32_t last;
    };
    constexpr CodePoints commands[] = {{0, 0x1f},        {0x7f, 0x9f},     {0x61c, 0x61c},
                                       {0x200e, 0x200f}, {0x2028, 0x202e}, {0x2066, 0x206f},
                                       {0xfeff, 0xfeff}, {0xfff9, 0xfffb}, {0xe0000, 0xe0fff}};
    return std::ranges::any_of(
        commands, [&](const CodePoints& range) { return range.first <= code && code <= range.last; });
}

std::string shown(std::uint32_t code) {
    if (code < 0x80) return fmt::format("\\x{:02x}", code);
    return code <= 0xffff ? fmt::format("\\u{:04x}", code) : fmt::format("\\U{:08x}", code);
}

std::string escaped_text(std::string_view text, std::size_t longest, bool keeps_lines) {
    constexpr std::string_view cut = "...";
    std::string escaped;
    std::size_t uncut = 0;  // length of `escaped` after which `cut` still fits
    while (!text.empty()) {
        const auto letter = first_letter(text);
        const std::size_t bytes = letter ? letter->bytes : 1;
        std::string piece(text.substr(0, bytes));
        if (!letter) {
            piece = fmt::format("\\x{:02x}", static_cast<unsigned char>(text[0]));
        } else if (is_command(letter->code) && !(keeps_lines && letter->code == '\n')) {
            piece = shown(letter->code);
        }
        if (escaped.size() + piece.size() > longest) return escaped.substr(0, uncut).append(cut);
        escaped += piece;
        if (escaped.size() + cut.size() <= longest) uncut = escaped.size();
        text.remove_prefix(bytes);
    }
    return escaped;
}

}  // namespace

std::string escape_untrusted(std::string_view text, std::size_t longest) {
    return escaped_text(text, longest, false);
}

std::string escape_untrusted_page(std::string_view text) {
    return escaped_text(text, std::string_view::npos, true);
}

}  // namespace peterka
