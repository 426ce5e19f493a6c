#include "curves/axes_of_file.hpp"

#include <limits>
#include <set>

#include "job/axis_key.hpp"
#include "map_file/layout.hpp"

namespace peterka::curves {

AxesOfFile::AxesOfFile(const job::Job& job)
    : column{0, job::column_key(job), map_file::coordinate_of(job::column_key(job))},
      row{1, job::row_key(job), map_file::coordinate_of(job::row_key(job))} {}

hdf5::Variable AxisOfFile::named(const char* prefix) const {
    return {name_of(prefix, coordinate), hdf5::Number::float64, std::numeric_limits<double>::quiet_NaN(),
            coordinate.units, coordinate.long_name};
}

const char* name_of(const char* prefix, const hdf5::Variable& coordinate) {
    static std::set<std::string> names;
    return names.insert(std::string(prefix) + coordinate.name).first->c_str();
}

}  // namespace peterka::curves
