// What the axes of the plane are called in a file of curves, and what is named after them.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "hdf5/variable.hpp"
#include "job/job.hpp"

namespace peterka::curves {

struct AxisOfFile {
    std::size_t number;    // 0 of the columns, 1 of the rows
    std::string_view key;  // what it runs over, as job::axis_quantity has it
    hdf5::Variable coordinate;

    // A dataset in its unit: "point_frequency_ratio" with "point_".
    [[nodiscard]] hdf5::Variable named(const char* prefix) const;
};

struct AxesOfFile {
    AxisOfFile column;
    AxisOfFile row;
    explicit AxesOfFile(const job::Job& job);  // which outlives it
};

// prefix and name together, which live as long as the program.
[[nodiscard]] const char* name_of(const char* prefix, const hdf5::Variable& coordinate);

}  // namespace peterka::curves
