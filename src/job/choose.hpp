// Words of a job that name a choice, and the message for a word that names none.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "job/document.hpp"

namespace peterka::job {

[[nodiscard]] std::optional<std::string> word_of(const Value& value);

[[nodiscard]] std::optional<std::size_t> index_of(std::string_view word,
                                                  const std::vector<std::string_view>& names);

[[nodiscard]] std::string quoted_list(const std::vector<std::string_view>& names);

// `what` names the key and the word.
[[nodiscard]] std::string complain_about_choice(std::string_view what, std::string_view word,
                                                const std::vector<std::string_view>& names);

}  // namespace peterka::job
