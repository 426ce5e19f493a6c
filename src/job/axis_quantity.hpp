// The quantities that an axis may vary: any number of the job that may differ from cell to cell.
//
// Each is named by its table and key (contact.damping_ns_per_m); frequency and gap, as ratios or in SI units,
// and the starts of a basin by their key alone. The lists follow from the schema of the job file.
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
    std::string long_name;   // without the unit
    std::string units;       // "N s/m"
    std::string from;        // examples
    std::string to;
    Range<double> range{};
    std::optional<ContactLaw> law = {};  // only for stops with this law
};

// The keys for maps and sweeps with this law, and whether a key is known but not numeric (for error messages).
[[nodiscard]] std::vector<std::string_view> axis_keys(ContactLaw law);
[[nodiscard]] bool is_no_number(std::string_view key);

// All quantities, including those of basins and of all laws.
[[nodiscard]] const std::vector<AxisQuantity>& axis_quantities();

// The quantity with this key, of any kind; nullptr if there is none.
[[nodiscard]] const AxisQuantity* find_quantity(std::string_view key);
[[nodiscard]] const AxisQuantity& quantity(std::string_view key);  // must exist

// The table and key that hold the value of such an axis in other jobs: "operating_point.gap_ratio" for
// "gap_ratio".
[[nodiscard]] std::string key_in_tables(std::string_view key);

// Names of the axes, or of a sweep's branches, in the file.
[[nodiscard]] AxisNames axis_names(const Job& job);

}  // namespace peterka::job
