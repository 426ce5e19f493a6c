// The cell of a map file that a trace follows, or that gives a basin its rig and operating point: selected by
// its indices, or by its values on the axes of that file, under the same tables and keys as in any job. Which
// axes these are is known once the file is read (run/traced_cell.hpp).
#pragma once

#include <cmath>
#include <initializer_list>
#include <limits>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "job/axis_quantity.hpp"
#include "job/job.hpp"
#include "job/key.hpp"
#include "job/range.hpp"
#include "job/rules.hpp"

namespace peterka::job {

template <typename Walker>
void describe_cell_of_map(Walker& table, CellOfMap& cell, const Key& map, std::string_view name) {
    constexpr auto index = from_to<std::int64_t>(-1, std::numeric_limits<std::int32_t>::max(),
                                                 "cells are counted from 0; -1 leaves the cell to its values");
    table.text(map, cell.map);
    table.integer({"row", "row of the cell in that file, from 0; -1: nearest to the values given"}, cell.row,
                  index);
    table.integer({"column", "column of the cell in that file, from 0; -1: the same"}, cell.column, index);
    table.rule({"map", "row", "column"}, [&] { return rule_of_cell_of_map(cell, name); });
}

// In each of these tables, any number that an axis may vary.
template <typename Walker>
void describe_values_of_cell(Walker& file, CellOfMap& cell, std::initializer_list<std::string_view> tables) {
    for (const std::string_view name : tables) {
        file.table({name, "values of the cell on the axes of the map"}, [&](auto& table) {
            for (const auto* word : {"law", "cubic"}) {
                table.refuse(word,
                             "is that of the job in the map's file; a cell is named by numbers on its axes; "
                             "remove this key");
            }
            for (const AxisQuantity& each : axis_quantities()) {
                const std::string key = key_in_tables(each.key);
                const bool is_again = key != each.key && name == "start";  // a basin's axis
                if (is_again || !key.starts_with(fmt::format("{}.", name))) continue;
                // the reader keeps this view: it points into the list's own text
                const std::string_view last = std::string_view(each.key).substr(each.key.find('.') + 1);
                double value = std::numeric_limits<double>::quiet_NaN();
                table.number({last, each.meaning}, value, each.range);
                if (!std::isnan(value)) cell.values[key] = value;
            }
        });
    }
}

// A basin with the rig and operating point of a map's cell. Once that file is read, they are in the basin's own
// tables.
template <typename Walker>
void describe_basin_of_map(Walker& file, Job& job) {
    const Key basin{
        .name = "basin", .meaning = "cell of a map whose rig and place the basin has", .is_written = false};
    file.table(basin, [&](auto& table) {
        const Key map{"map", "file of the map with that cell", "\"peterka_170mm.h5\""};
        describe_cell_of_map(table, job.cell, map, "basin");
    });
    if (job.cell.map.empty()) return;
    file.refuse("rig", "names a rig; the basin has that of the cell that basin.map names; remove one of them");
    describe_values_of_cell(file, job.cell, {"operating_point", "hammer", "cart", "contact"});
}

}  // namespace peterka::job
