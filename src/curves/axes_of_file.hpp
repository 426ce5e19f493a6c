// Names of the plane's axes in a file of curves, and of the datasets named after them.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "hdf5/variable.hpp"
#include "job/job.hpp"

namespace peterka::curves {

struct AxisOfFile {
    std::size_t number;    // 0: columns, 1: rows
    std::string_view key;  // its quantity, as in job::axis_quantity
    hdf5::Variable coordinate;

    // A dataset in this axis's unit: "point_frequency_ratio" for the prefix "point_".
    [[nodiscard]] hdf5::Variable named(const char* prefix) const;
};

struct AxesOfFile {
    AxisOfFile column;
    AxisOfFile row;
    explicit AxesOfFile(const job::Job& job);  // the job must outlive this object
};

// prefix + name, stored for the lifetime of the program.
[[nodiscard]] const char* name_of(const char* prefix, const hdf5::Variable& coordinate);

}  // namespace peterka::curves
