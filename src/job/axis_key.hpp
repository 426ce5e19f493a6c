// The quantities that the axes of a job vary, by name: table and key (contact.damping_ns_per_m), or the key
// alone for frequency and gap, as ratios or in SI units, and for the starts of a basin.
#pragma once

#include <string_view>

#include "job/job.hpp"

namespace peterka::job {

// Whether two keys are equal or alternatives: axes over both would be redundant.
[[nodiscard]] bool says_the_same(std::string_view key, std::string_view other);

// Whether the axes of such a job may vary any numbers.
[[nodiscard]] constexpr bool has_any_axes(Kind kind) {
    return kind == Kind::map || kind == Kind::sweep || kind == Kind::curves;
}

struct ChosenAxes {
    int count = 2;          // axes to be read
    bool are_known = true;  // false: one is faulty; what depends on it is no further fault
};

// The axis key of a number named by table and key: "gap_m" for "operating_point.gap_m", others as they are.
[[nodiscard]] std::string_view axis_key_of(std::string_view key_in_tables);

// The quantity that each axis of a job varies.
[[nodiscard]] std::string_view column_key(const Job& job);
[[nodiscard]] std::string_view row_key(const Job& job);  // not for a sweep

[[nodiscard]] bool is_frequency(std::string_view key);
[[nodiscard]] bool is_gap(std::string_view key);
[[nodiscard]] bool is_displacement(std::string_view key);  // of a basin's start
[[nodiscard]] bool is_velocity(std::string_view key);
[[nodiscard]] inline bool is_start_of_basin(std::string_view key) {
    return is_displacement(key) || is_velocity(key);
}
[[nodiscard]] bool is_of_rig(std::string_view key);  // of hammer, cart or contact

// Why curves cannot have such an axis; "" if they can.
[[nodiscard]] std::string_view why_no_curves_over(std::string_view key);

// Whether an axis of a map or sweep varies such a quantity.
[[nodiscard]] bool has_axis(const Job& job, bool (*is_it)(std::string_view key));

}  // namespace peterka::job
