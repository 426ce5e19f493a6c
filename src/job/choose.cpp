#include "job/choose.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "job/nearest.hpp"
#include "job/toml_text.hpp"

namespace peterka::job {

std::optional<std::string> word_of(const Value& value) {
    if (const auto* text = value.as<std::string>()) return *text;
    if (const auto* word = value.as<BareWord>()) return word->text;
    return std::nullopt;
}

std::optional<std::size_t> index_of(std::string_view word, const std::vector<std::string_view>& names) {
    const auto found = std::find(names.begin(), names.end(), word);
    if (found == names.end()) return std::nullopt;
    return static_cast<std::size_t>(found - names.begin());
}

std::string quoted_list(const std::vector<std::string_view>& names) {
    std::string list;
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (i > 0) list += i + 1 == names.size() ? " and " : ", ";
        list += toml_text(names[i]);
    }
    return list;
}

std::string complain_about_choice(std::string_view what, std::string_view word,
                                  const std::vector<std::string_view>& names) {
    const auto meant = nearest(word, names);
    return fmt::format("{} is unknown; this version has {}; {}", what, quoted_list(names),
                       meant.empty() ? "choose from these" : fmt::format("did you mean {}?", toml_text(meant)));
}

}  // namespace peterka::job
