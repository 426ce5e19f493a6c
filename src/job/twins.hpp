// The two units of a coordinate: frequency, gap and start are given as ratios or in SI units, and nothing else
// of a job, a file or a picture asks which.
//
//   frequency_hz = frequency_ratio omega/(2 pi), gap_m = gap_ratio A0, displacement_m = displacement_ratio A0,
//   velocity_m_per_s = velocity_ratio A0 omega
//
// Both names of each, and what the one is worth in the other for the rig of a cell, are told here alone.
#pragma once

#include <optional>
#include <string_view>

#include "job/cell_numbers.hpp"
#include "job/job.hpp"

namespace peterka::job {

// The other key of the same coordinate: "gap_m" of "gap_ratio", "gap_ratio" of "gap_m"; "" where there is none.
[[nodiscard]] std::string_view twin_of(std::string_view key);

// Whether a key gives such a coordinate in SI units.
[[nodiscard]] bool is_in_si(std::string_view key);

// What a ratio of 1 is in SI units, for the rig of a cell; of either key.
[[nodiscard]] double unit_of(std::string_view key, const CellNumbers& rig);

// A value of the one key as one of the other.
[[nodiscard]] double as_twin(std::string_view key, double value, const CellNumbers& rig);

// The name and the values of the coordinate that stands in the file beside that of an axis, or of the gaps of a
// sweep's branches: nothing where it isn't a function of the axis alone, for the rig changes its unit from cell
// to cell.
struct Twin {
    std::string_view key;  // its own
    std::string_view of;   // of the axis
    CellNumbers rig;       // which has the unit of all cells

    [[nodiscard]] double value(double of_axis) const { return as_twin(of, of_axis, rig); }
};
[[nodiscard]] std::optional<Twin> twin_of_columns(const Job& job);
[[nodiscard]] std::optional<Twin> twin_of_rows(const Job& job);  // not of a sweep
[[nodiscard]] std::optional<Twin> twin_of_branches(const Job& job);

}  // namespace peterka::job
