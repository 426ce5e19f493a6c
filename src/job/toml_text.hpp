// Values as TOML text, which reads back as the same value, bit for bit.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace peterka::job {

[[nodiscard]] std::string toml_text(double value);  // the shortest text that reads back equal, always a float
[[nodiscard]] std::string toml_text(std::int64_t value);
[[nodiscard]] std::string toml_text(std::string_view value);  // in quotes, control characters escaped
[[nodiscard]] std::string toml_key(std::string_view key);     // quoted only if necessary

}  // namespace peterka::job
