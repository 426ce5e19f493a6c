#include "run/traced_cell.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "job/axis.hpp"
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
    const double step = (place(axis.to) - place(axis.from)) / static_cast<double>(axis.points - 1);
    const double index = (place(value) - place(axis.from)) / step;
    constexpr double half = 0.5 + 1e-9;  // a cell reaches half a step out
    if (index >= -half && index <= static_cast<double>(axis.points - 1) + half) {
        return std::clamp<std::int64_t>(std::llround(index), 0, axis.points - 1);
    }
    refuse(fmt::format("{} = {} lies outside of the map, whose axis runs from {} to {}; give a value inside",
                       name, value, axis.from, axis.to));
}

// The two values that name a cell of this kind of plane, and the two that its job has for all cells.
struct Values {
    const char* table;  // of those that name a cell
    double column;
    double row;
    const char* other_table;
    bool has_other;
};

Values values_of(const job::Job& job, job::Kind kind) {
    const auto& [frequency, gap] = job.operating_point;
    const auto& [displacement, velocity] = job.start;
    const bool has_place = !std::isnan(frequency) || !std::isnan(gap);
    const bool has_start = !std::isnan(displacement) || !std::isnan(velocity);
    if (kind == job::Kind::basin) return {"start", displacement, velocity, "operating_point", has_place};
    return {"operating_point", frequency, gap, "start", has_start};
}

Place cell_of(const job::Job& job, const job::Job& map) {
    const Values values = values_of(job, map.kind);
    const auto names = job::axis_names(map.kind);
    if (values.has_other) {
        refuse(fmt::format("[{}] is that of the {}'s own job, the same for all its cells; remove this table",
                           values.other_table, job::name(map.kind)));
    }
    const bool has_values = !std::isnan(values.column) || !std::isnan(values.row);
    if (job.trace.row >= 0) {
        if (has_values) {
            refuse(fmt::format(
                "trace.row and trace.column name a cell, and [{}] names one, too; remove one of them",
                values.table));
        }
        return {checked_index("row", job.trace.row, map.rows),
                checked_index("column", job.trace.column, map.columns)};
    }
    if (std::isnan(values.column) || std::isnan(values.row)) {
        refuse(fmt::format("no cell of the {} is named; give trace.row and trace.column, or {}.{} and {}.{}",
                           job::name(map.kind), values.table, names.columns, values.table, names.rows));
    }
    return {nearest(map.rows, fmt::format("{}.{}", values.table, names.rows), values.row),
            nearest(map.columns, fmt::format("{}.{}", values.table, names.columns), values.column)};
}

job::Job job_of_cell(const job::Job& job, const job::Job& map, const Place& cell) {
    job::Job own = map;
    own.kind = job::Kind::trace;
    own.title = job.title.empty() ? map.title : job.title;
    own.trace = job.trace;
    own.output.anonymous = job.output.anonymous;
    own.trace.map.clear();
    own.trace.row = own.trace.column = -1;
    const double column = job::axis_value(map.columns, cell.column);
    const double row = job::axis_value(map.rows, cell.row);
    if (map.kind == job::Kind::basin) {
        own.start = {column, row};
    } else {
        own.operating_point = {column, row};
    }
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
