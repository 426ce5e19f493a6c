// The two units of a coordinate: frequency, gap and start are given as ratios or in SI units, and nothing else
// in a job, a file or a figure depends on which.
//
//   frequency_hz = frequency_ratio omega/(2 pi), gap_m = gap_ratio A0, displacement_m = displacement_ratio A0,
//   velocity_m_per_s = velocity_ratio A0 omega
//
// Only this file defines both names of each and their conversion for the rig of a cell.
#pragma once

#include <optional>
#include <string_view>

#include "job/cell_numbers.hpp"
#include "job/job.hpp"

namespace peterka::job {

// The other key of the same coordinate: "gap_m" for "gap_ratio", "gap_ratio" for "gap_m"; "" if there is none.
[[nodiscard]] std::string_view twin_of(std::string_view key);

// Whether a key gives such a coordinate in SI units.
[[nodiscard]] bool is_in_si(std::string_view key);

// The value of a ratio of 1 in SI units, for the rig of a cell; for either key.
[[nodiscard]] double unit_of(std::string_view key, const CellNumbers& rig);

// Converts a value of one key to the other.
[[nodiscard]] double as_twin(std::string_view key, double value, const CellNumbers& rig);

// Whether a coordinate, by either of its keys, is told in SI units first: where the job gives it so, on an
// axis, in a list or as a single value. With an empty key: whether it gives any coordinate of its axes so, or
// of its place if it has no axes.
[[nodiscard]] bool leads_in_si(const Job& job, std::string_view key = {});

// The name and values of the coordinate stored in the file beside that of an axis, or of the gaps of a sweep's
// branches; none if it is not a function of the axis alone because its unit varies with the rig from cell to
// cell.
struct Twin {
    std::string_view key;  // its own
    std::string_view of;   // of the axis
    CellNumbers rig;       // which gives the unit for all cells

    [[nodiscard]] double value(double of_axis) const { return as_twin(of, of_axis, rig); }
};
[[nodiscard]] std::optional<Twin> shared_twin(const Job& job, std::string_view key);  // of any coordinate
[[nodiscard]] std::optional<Twin> twin_of_columns(const Job& job);
[[nodiscard]] std::optional<Twin> twin_of_rows(const Job& job);  // not for a sweep
[[nodiscard]] std::optional<Twin> twin_of_branches(const Job& job);

}  // namespace peterka::job
