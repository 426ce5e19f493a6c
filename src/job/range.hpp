// The values a number may take, and the physical reason.
#pragma once

#include <limits>
#include <string>
#include <string_view>

namespace peterka::job {

template <typename Number>
struct Range {
    Number low;
    Number high;
    std::string_view reason;

    [[nodiscard]] bool contains(Number value) const { return low <= value && value <= high; }
    [[nodiscard]] std::string text() const;  // in range.cpp, for double and std::int64_t
};

template <typename Number>
[[nodiscard]] constexpr Range<Number> from_to(Number low, Number high, std::string_view reason) {
    return {low, high, reason};
}

// Magnitudes in SI units. Far beyond any hammer, and narrow enough that every number derived from them is
// finite.
inline constexpr double smallest_magnitude = 1e-30;
inline constexpr double largest_magnitude = 1e30;

[[nodiscard]] constexpr Range<double> positive(std::string_view reason) {
    return from_to(smallest_magnitude, largest_magnitude, reason);
}

[[nodiscard]] constexpr Range<double> not_negative(std::string_view reason) {
    return from_to(0.0, largest_magnitude, reason);
}

}  // namespace peterka::job
