// Numbers as a person reads them: counts with separators, durations, amounts of memory; names as a shell reads
// them.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace peterka {

[[nodiscard]] std::string readable_count(std::int64_t count);  // 262144 -> "262,144"
// Of counts: 25 -> "25.0", 1974.2 -> "1,974".
[[nodiscard]] std::string readable_mean(double mean);
[[nodiscard]] std::string readable_duration(double seconds);   // 3725 -> "1 h 2 min", 0.00125 -> "1.3 ms"
[[nodiscard]] std::string readable_bytes(std::int64_t bytes);  // 1536000 -> "1.5 MB" (powers of 1000)
// With `digits` digits and the prefix that keeps the number between 1 and 1000: 2714 N -> "2.714 kN".
[[nodiscard]] std::string readable_amount(double amount, std::string_view unit, int digits = 4);
[[nodiscard]] std::string readable_share(std::int64_t part,
                                         std::int64_t whole);  // 1 of 3 -> "33.3 %"; only 0 is 0.0 %

// A file's name as one word of a command line: quoted if a shell would read it differently.
[[nodiscard]] std::string shell_word(std::string_view text);

}  // namespace peterka
