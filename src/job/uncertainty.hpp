// The table [uncertainty] as plain structs: which numbers of the rig and of the place are uncertain, and by how
// much. Numbers are named by table and key, as in "contact.damping_ns_per_m" or "operating_point.gap_m".
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace peterka::job {

// How far a number may be from the job's own value. Exactly one of relative, standard_deviation, and from with
// to, is given. For a number of the place, from and to are offsets.
struct Spread {
    std::optional<double> relative = {};            // standard deviation over the job's own value [1]
    std::optional<double> standard_deviation = {};  // in the number's unit
    std::optional<double> from = {};                // uniform between these, in the number's unit
    std::optional<double> to = {};
    [[nodiscard]] bool is_given() const { return relative || standard_deviation || from || to; }
    friend bool operator==(const Spread&, const Spread&) = default;
};

// Numbers that are uncertain together, as identify.py tells them. Draws are around the job's own values; `mean`
// is what was identified.
struct Covariance {
    std::vector<std::string> of;
    std::vector<double> mean;                 // in SI units, of each of them
    std::vector<std::vector<double>> matrix;  // in the products of these units, row by row
    friend bool operator==(const Covariance&, const Covariance&) = default;
};

struct Uncertainty {
    std::int64_t rigs = 0;  // drawn for each cell; 0: none
    Covariance covariance;
    std::map<std::string, Spread> numbers;  // each by itself
    friend bool operator==(const Uncertainty&, const Uncertainty&) = default;
};

}  // namespace peterka::job
