#include "job/range.hpp"

#include <fmt/format.h>

#include <cstdint>

#include "job/toml_text.hpp"

namespace peterka::job {

template <typename Number>
std::string Range<Number>::text() const {
    const std::string first = toml_text(low);
    const std::string last = toml_text(high);
    if (low == high) return "the value " + first;
    if (high == std::numeric_limits<Number>::max()) return fmt::format("a value of {} or more", first);
    return fmt::format("a value from {} to {}", first, last);
}

template struct Range<double>;
template struct Range<std::int64_t>;

}  // namespace peterka::job
