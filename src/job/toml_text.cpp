#include "job/toml_text.hpp"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>

namespace peterka::job {
namespace {

bool is_bare(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '-';
}

bool is_control(unsigned char c) {
    return c < 0x20 || c == 0x7f;
}

}  // namespace

std::string toml_text(double value) {
    std::string text = fmt::format("{}", value);
    const bool looks_like_an_integer = text.find_first_of(".en") == std::string::npos;
    return looks_like_an_integer ? text + ".0" : text;
}

std::string toml_text(std::int64_t value) {
    return fmt::format("{}", value);
}

std::string toml_text(std::string_view value) {
    std::string text = "\"";
    for (std::size_t i = 0; i < value.size(); ++i) {
        const auto c = static_cast<unsigned char>(value[i]);
        const auto next = i + 1 < value.size() ? static_cast<unsigned char>(value[i + 1]) : 0;
        // U+0080 to U+009F, in UTF-8 C2 80 to C2 9F, are commands to a terminal.
        const bool is_wide_control = c == 0xc2 && next >= 0x80 && next <= 0x9f;
        if (is_wide_control) {
            text += fmt::format("\\u{:04X}", next);
            ++i;
        } else if (is_control(c)) {
            text += fmt::format("\\u{:04X}", c);
        } else if (c == '"' || c == '\\') {
            text += {'\\', value[i]};
        } else {
            text += value[i];
        }
    }
    return text + '"';
}

std::string toml_key(std::string_view key) {
    const bool bare = !key.empty() && std::all_of(key.begin(), key.end(), is_bare);
    return bare ? std::string(key) : toml_text(key);
}

}  // namespace peterka::job
