#include "support/readable.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace peterka {

std::string readable_count(std::int64_t count) {
    std::string digits = std::to_string(count);
    const std::size_t first_digit = count < 0 ? 1 : 0;
    for (std::size_t place = digits.size(); place > first_digit + 3;) {
        place -= 3;
        digits.insert(place, ",");
    }
    return digits;
}

std::string readable_mean(double mean) {
    constexpr double large = 999.95;  // 1,000 with a decimal
    return mean < large ? fmt::format("{:.1f}", mean) : readable_count(std::llround(mean));
}

std::string readable_duration(double seconds) {
    if (!std::isfinite(seconds) || seconds < 0) return "unknown";
    if (seconds < 1e-3) return fmt::format("{:.1f} us", seconds * 1e6);
    if (seconds < 1) return fmt::format("{:.1f} ms", seconds * 1e3);
    if (seconds < 59.95) return fmt::format("{:.1f} s", seconds);
    if (seconds > 1e15) return "ages";

    const std::int64_t whole = std::llround(seconds);
    const std::int64_t minutes = whole / 60;
    const std::int64_t hours = minutes / 60;
    if (hours == 0) return fmt::format("{} min {} s", minutes, whole % 60);
    if (hours < 48) return fmt::format("{} h {} min", hours, minutes % 60);
    return fmt::format("{} days {} h", hours / 24, hours % 24);
}

std::string readable_bytes(std::int64_t bytes) {
    constexpr std::array units{"bytes", "kB", "MB", "GB", "TB", "PB", "EB"};
    auto amount = static_cast<double>(bytes);
    std::size_t unit = 0;
    while (amount >= 999.95 && unit + 1 < units.size()) {
        amount /= 1000;
        ++unit;
    }
    return unit == 0 ? fmt::format("{} bytes", bytes) : fmt::format("{:.1f} {}", amount, units.at(unit));
}

std::string readable_amount(double amount, std::string_view unit, int digits) {
    constexpr std::array prefixes{"n", "u", "m", "", "k", "M", "G", "T"};
    constexpr int of_none = 3;
    if (!std::isfinite(amount) || amount == 0) return fmt::format("{:g} {}", amount, unit);
    const double rounded = std::stod(fmt::format("{:.{}e}", amount, digits - 1));  // 999.96 is 1 k
    const int thousands = static_cast<int>(std::floor(std::log10(std::abs(rounded)) / 3 + 1e-12));
    const int place = std::clamp(of_none + thousands, 0, static_cast<int>(prefixes.size()) - 1);
    return fmt::format("{:.{}g} {}{}", rounded / std::pow(1000.0, place - of_none), digits,
                       prefixes.at(static_cast<std::size_t>(place)), unit);
}

std::string readable_share(std::int64_t part, std::int64_t whole) {
    const double percent = whole > 0 ? 100.0 * static_cast<double>(part) / static_cast<double>(whole) : 0.0;
    const bool would_be_none = part > 0 && percent < 0.05;
    const bool would_be_all = part < whole && percent >= 99.95;
    return would_be_none ? "< 0.05 %" : would_be_all ? "> 99.95 %" : fmt::format("{:.1f} %", percent);
}

std::string shell_word(std::string_view text) {
    constexpr std::string_view plain =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./,:@%";
    if (!text.empty() && text.find_first_not_of(plain) == std::string_view::npos) return std::string(text);
    std::string word = "'";
    for (const char c : text) word += c == '\'' ? "'\\''" : std::string(1, c);
    return word + "'";
}

}  // namespace peterka
