// What an axis may run over: any number of the job that a cell may have for itself.
//
// It is named by its table and key, contact.damping_ns_per_m; frequency and gap, as ratios or in SI units, by
// their key alone, and so are the starts of a basin. The lists follow from the schema of the job file.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "job/axis_key.hpp"
#include "job/job.hpp"
#include "job/names.hpp"
#include "job/range.hpp"

namespace peterka::job {

struct AxisQuantity {
    std::string key;         // "contact.damping_ns_per_m"
    std::string coordinate;  // its name in a file: "contact_damping_ns_per_m"
    std::string meaning;     // with its unit in brackets
    std::string long_name;   // without
    std::string units;       // "N s/m"
    std::string from;        // examples
    std::string to;
    Range<double> range{};
    std::optional<ContactLaw> law = {};  // of a stop that has it
};

// Of maps and sweeps with this law; those of other laws, and keys that are no numbers, for what to say of them.
[[nodiscard]] std::vector<std::string_view> axis_keys(ContactLaw law);
[[nodiscard]] bool is_no_number(std::string_view key);

// All of them, with those of basins and of any law.
[[nodiscard]] const std::vector<AxisQuantity>& axis_quantities();

// Any of them; nullptr where there is none with this key.
[[nodiscard]] const AxisQuantity* find_quantity(std::string_view key);
[[nodiscard]] const AxisQuantity& quantity(std::string_view key);  // there is one

// The table and key that have the value of such an axis in other jobs: "operating_point.gap_ratio" of
// "gap_ratio".
[[nodiscard]] std::string key_in_tables(std::string_view key);

// Names in the file: of the axes, or of a sweep's branches.
[[nodiscard]] AxisNames axis_names(const Job& job);

}  // namespace peterka::job
