// The columns of a table in a file of curves: one dimension, one number per row.
#pragma once

#include <limits>
#include <vector>

#include "curves/mpi_packing.hpp"
#include "map_file/table.hpp"

namespace peterka::curves {

using hdf5::Number;
using hdf5::Variable;
using map_file::Dimension;
using map_file::Table;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

class Columns {
  public:
    Columns(const char* group, const char* dimension, std::int64_t size)
        : group_(group), name_(dimension), dimension_{dimension, size} {}

    void add(const Variable& variable, const Numbers& values) {
        tables_.push_back({{group_, variable, {dimension_}}, values});
    }
    void add_counter(const char* meaning) {
        Numbers counts;
        for (std::int64_t i = 0; i < dimension_.size; ++i) counts.push_back(static_cast<double>(i));
        add({name_, Number::int64, -1, "1", meaning}, counts);
    }
    [[nodiscard]] const std::vector<Table>& tables() const { return tables_; }

  private:
    const char* group_;
    const char* name_;  // of the dimension; tables keep no copy of it
    Dimension dimension_;
    std::vector<Table> tables_;
};

template <class Items, class Value>
Numbers numbers_of(const Items& items, Value&& value) {
    Numbers numbers;
    for (const auto& item : items) numbers.push_back(static_cast<double>(value(item)));
    return numbers;
}

}  // namespace peterka::curves
