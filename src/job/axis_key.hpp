// What the axes of a job run over, by name: a table and key, contact.damping_ns_per_m, or the key alone of
// frequency and gap, as ratios or in SI units, and of the starts of a basin.
#pragma once

#include <string_view>

#include "job/job.hpp"

namespace peterka::job {

// Keys of which a job gives one of two: their axes would say the same twice.
[[nodiscard]] bool says_the_same(std::string_view key, std::string_view other);

// Whether the axes of such a job run over any numbers.
[[nodiscard]] constexpr bool has_any_axes(Kind kind) {
    return kind == Kind::map || kind == Kind::sweep || kind == Kind::curves;
}

struct ChosenAxes {
    int count = 2;          // that are to be read
    bool are_known = true;  // else one of them is at fault, and what depends on it is no fault of its own
};

// What the axes of a job run over.
[[nodiscard]] std::string_view column_key(const Job& job);
[[nodiscard]] std::string_view row_key(const Job& job);  // not of a sweep

[[nodiscard]] bool is_frequency(std::string_view key);
[[nodiscard]] bool is_gap(std::string_view key);
[[nodiscard]] bool is_displacement(std::string_view key);  // of a basin's start
[[nodiscard]] bool is_velocity(std::string_view key);
[[nodiscard]] inline bool is_start_of_basin(std::string_view key) {
    return is_displacement(key) || is_velocity(key);
}
[[nodiscard]] bool is_of_rig(std::string_view key);  // of hammer, cart or contact

// Why curves have no such axis; "" where they may.
[[nodiscard]] std::string_view why_no_curves_over(std::string_view key);

// Whether one of the axes of a map or sweep runs over it.
[[nodiscard]] bool has_axis(const Job& job, bool (*is_it)(std::string_view key));

}  // namespace peterka::job
