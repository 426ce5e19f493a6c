#include "run/traced_cell.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "job/axis.hpp"
#include "job/axis_quantity.hpp"
#include "job/cell_numbers.hpp"
#include "job/names.hpp"
#include "job/read.hpp"
#include "job/write.hpp"
#include "parallel/tiles.hpp"
#include "support/errors.hpp"

namespace peterka {
namespace {

using job::Axis;
using parallel::Place;

[[noreturn]] void refuse(const std::string& text) {
    throw Failure(ExitCode::bad_job, text);
}

std::int64_t checked_index(const char* name, std::int64_t index, const Axis& axis) {
    if (index < axis.points) return index;
    refuse(fmt::format("trace.{} = {} is out of range; the map has {} of them, counted from 0; give 0 to {}",
                       name, index, axis.points, axis.points - 1));
}

// The point of an axis that is nearest to a value, in the logarithm where the axis is logarithmic.
std::int64_t nearest(const Axis& axis, std::string_view name, double value) {
    const auto place = [&](double at) { return axis.scale == job::Spacing::log ? std::log(at) : at; };
    if (axis.points == 1) return 0;
    const double step = (place(axis.to) - place(axis.from)) / static_cast<double>(axis.points - 1);
    const double index = (place(value) - place(axis.from)) / step;
    constexpr double half = 0.5 + 1e-9;  // a cell reaches half a step out
    if (index >= -half && index <= static_cast<double>(axis.points - 1) + half) {
        return std::clamp<std::int64_t>(std::llround(index), 0, axis.points - 1);
    }
    refuse(fmt::format("{} = {} lies outside of the map, whose axis runs from {} to {}; give a value inside",
                       name, value, axis.from, axis.to));
}

// The two values that name a cell of this plane; NaN where the job gives none.
struct Values {
    double column;
    double row;
};

// A table of this job names a value of an axis as the map's own job would give it.
double value_of(const job::Job& job, std::string_view key) {
    if (key == "frequency_ratio") return job.operating_point.frequency_ratio;
    if (key == "gap_ratio") return job.operating_point.gap_ratio;
    if (key.ends_with("displacement_ratio")) return job.start.displacement_ratio;
    if (key.ends_with("velocity_ratio")) return job.start.velocity_ratio;
    return std::numeric_limits<double>::quiet_NaN();
}

bool is_named_by_value(std::string_view key) {
    return key == "frequency_ratio" || key == "gap_ratio" || key.ends_with("displacement_ratio") ||
           key.ends_with("velocity_ratio");
}

// "operating_point.gap_ratio"
std::string name_of(std::string_view key) {
    if (key.starts_with("start.")) return std::string(key);
    const bool is_start = key == "displacement_ratio" || key == "velocity_ratio";
    return fmt::format("{}.{}", is_start ? "start" : "operating_point", key);
}

// A value that is given for no axis is one that all cells of the map share.
void refuse_other_values(const job::Job& job, const job::Job& map) {
    const auto is_axis = [&](std::string_view key) {
        return name_of(column_key(map)) == key || name_of(row_key(map)) == key;
    };
    for (const auto* key : {"operating_point.frequency_ratio", "operating_point.gap_ratio",
                            "start.displacement_ratio", "start.velocity_ratio"}) {
        const std::string_view name(key);
        const std::string_view table = name.substr(0, name.find('.'));
        if (is_axis(name) || std::isnan(value_of(job, name.substr(name.find('.') + 1)))) continue;
        const bool table_has_axis =
            name_of(column_key(map)).starts_with(table) || name_of(row_key(map)).starts_with(table);
        if (table_has_axis) {
            refuse(fmt::format("{} is that of the {}'s own job, the same for all its cells; remove this key",
                               name, job::name(map.kind)));
        }
        refuse(fmt::format("[{}] is that of the {}'s own job, the same for all its cells; remove this table",
                           table, job::name(map.kind)));
    }
}

Place cell_of(const job::Job& job, const job::Job& map) {
    refuse_other_values(job, map);
    const std::string columns = name_of(column_key(map));
    const std::string rows = name_of(row_key(map));
    const Values values{value_of(job, column_key(map)), value_of(job, row_key(map))};
    if (job.trace.row >= 0) {
        if (!std::isnan(values.column) || !std::isnan(values.row)) {
            refuse(fmt::format(
                "trace.row and trace.column name a cell, and [{}] names one, too; remove one of them",
                std::isnan(values.column) ? rows.substr(0, rows.find('.'))
                                          : columns.substr(0, columns.find('.'))));
        }
        return {checked_index("row", job.trace.row, map.rows),
                checked_index("column", job.trace.column, map.columns)};
    }
    if (!is_named_by_value(column_key(map)) || !is_named_by_value(row_key(map))) {
        refuse(fmt::format(
            "no cell of the {} is named; its axes run over {} and {}; give trace.row and trace.column",
            job::name(map.kind), column_key(map), row_key(map)));
    }
    if (std::isnan(values.column) || std::isnan(values.row)) {
        refuse(fmt::format("no cell of the {} is named; give trace.row and trace.column, or {} and {}",
                           job::name(map.kind), columns, rows));
    }
    return {nearest(map.rows, rows, values.row), nearest(map.columns, columns, values.column)};
}

job::Job job_of_cell(const job::Job& job, const job::Job& map, const Place& cell) {
    job::Job own = map;
    own.kind = job::Kind::trace;
    own.title = job.title.empty() ? map.title : job.title;
    own.trace = job.trace;
    own.output.anonymous = job.output.anonymous;
    own.trace.map.clear();
    own.trace.row = own.trace.column = -1;
    own.columns = own.rows = {};
    const job::CellNumbers numbers = job::numbers_at(map, cell.row, cell.column);
    own.hammer = numbers.hammer;
    own.cart = numbers.cart;
    own.contact = numbers.contact;
    own.operating_point = numbers.place;
    own.start = numbers.start;
    // the rules of a trace hold for it, and whatever belongs to a plane alone is left behind
    return job::read_job_text(job::resolved_text(own), job.trace.map);
}

}  // namespace

TracedCell find_traced_cell(const job::Job& job) {
    if (job.kind != job::Kind::trace || job.trace.map.empty()) return {job, std::nullopt};
    const job::Job map = map_file::read_map_job(job.trace.map);
    const Place cell = cell_of(job, map);
    return {job_of_cell(job, map, cell), map_file::read_map_cell(job.trace.map, map, cell.row, cell.column)};
}

}  // namespace peterka
