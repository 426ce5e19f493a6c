#include "run/traced_cell.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include "job/axis.hpp"
#include "job/axis_key.hpp"
#include "job/axis_quantity.hpp"
#include "job/cell_numbers.hpp"
#include "job/names.hpp"
#include "job/read.hpp"
#include "job/twins.hpp"
#include "job/write.hpp"
#include "parallel/tiles.hpp"
#include "support/errors.hpp"

namespace peterka {
namespace {

using job::Axis;
using parallel::CellIndex;

[[noreturn]] void refuse(const std::string& text) {
    throw Failure(ExitCode::bad_job, text);
}

// [trace] or [basin], the table in which the job names the cell.
std::string_view table_of(const job::Job& job) {
    return job::name(job.kind);
}

std::int64_t checked_index(const std::string& name, std::int64_t index, const Axis& axis) {
    if (index < axis.points) return index;
    refuse(fmt::format("{} = {} is out of range; the map has {} of them, counted from 0; give 0 to {}", name,
                       index, axis.points, axis.points - 1));
}

// The point of an axis nearest to a value, in logarithms if the axis is logarithmic.
std::int64_t nearest(const Axis& axis, std::string_view name, double value) {
    const auto place = [&](double at) { return axis.scale == job::Spacing::log ? std::log(at) : at; };
    if (axis.points == 1) return 0;
    const double step = (place(axis.to) - place(axis.from)) / static_cast<double>(axis.points - 1);
    const double index = (place(value) - place(axis.from)) / step;
    constexpr double half = 0.5 + 1e-9;  // a cell extends by half a step
    if (index >= -half && index <= static_cast<double>(axis.points - 1) + half) {
        return std::clamp<std::int64_t>(std::llround(index), 0, axis.points - 1);
    }
    refuse(fmt::format("{} = {} lies outside of the map, whose axis runs from {} to {}; give a value inside",
                       name, value, axis.from, axis.to));
}

// The keys in this job's tables that name a cell by its place on the axes of the map.
struct Keys {
    std::string column;
    std::string row;
};

Keys keys_of_axes(const job::Job& map) {
    return {job::key_in_tables(column_key(map)), job::key_in_tables(row_key(map))};
}

// The name of a map's or basin's axis for a key in this job's tables.
std::string_view axis_of(const job::Job& map, std::string_view key) {
    constexpr std::string_view place = "operating_point.";
    constexpr std::string_view start = "start.";
    if (key.starts_with(place)) return key.substr(place.size());
    return map.kind == job::Kind::basin && key.starts_with(start) ? key.substr(start.size()) : key;
}

// The values that name the cell, in the units of the map's axes. Refuses a value on no axis: all cells of the
// map share it, or it repeats an axis in another unit.
std::map<std::string, double> values_on_axes(const job::CellOfMap& cell, const job::Job& map) {
    const Keys axes = keys_of_axes(map);
    std::map<std::string, double> values;
    const auto take = [&](const std::string& key, const std::string& axis, double value) {
        if (!values.emplace(axis, value).second)
            refuse(fmt::format("{} says what {} says; remove one of them", key, axis));
    };
    for (const auto& [key, value] : cell.values) {
        if (key == axes.column || key == axes.row) {
            take(key, key, value);
            continue;
        }
        const std::string_view quantity = axis_of(map, key);
        const auto columns = job::twin_of_columns(map);
        const auto rows = job::twin_of_rows(map);
        if (columns && columns->key == quantity) {
            take(key, axes.column, job::as_twin(quantity, value, columns->rig));
            continue;
        }
        if (rows && rows->key == quantity) {
            take(key, axes.row, job::as_twin(quantity, value, rows->rig));
            continue;
        }
        for (const std::string_view axis : {column_key(map), row_key(map)}) {
            if (!job::says_the_same(quantity, axis)) continue;
            refuse(fmt::format("{} says what the {}'s axis says as {}; give that key instead", key,
                               job::name(map.kind), job::key_in_tables(axis)));
        }
        refuse(
            fmt::format("{} is that of the {}'s own job, the same for all its cells; its axes run over {} "
                        "and {}; remove this key",
                        key, job::name(map.kind), column_key(map), row_key(map)));
    }
    return values;
}

// The cell that a job names, with the requested values on the map's axes if it is named by them.
struct Named {
    CellIndex cell;
    std::optional<double> column;
    std::optional<double> row;
};

Named cell_of(const job::Job& job, const job::Job& map) {
    const job::CellOfMap& cell = job.cell;
    const std::map<std::string, double> values = values_on_axes(cell, map);
    const auto [column, row] = keys_of_axes(map);
    if (cell.row >= 0) {
        if (!cell.values.empty()) {
            refuse(fmt::format("{0}.row and {0}.column name a cell, and {1} names one, too; remove one of them",
                               table_of(job), cell.values.begin()->first));
        }
        const CellIndex place{checked_index(fmt::format("{}.row", table_of(job)), cell.row, map.rows),
                              checked_index(fmt::format("{}.column", table_of(job)), cell.column, map.columns)};
        return {place, std::nullopt, std::nullopt};
    }
    if (!values.contains(column) || !values.contains(row)) {
        refuse(fmt::format("no cell of the {0} is named; give {3}.row and {3}.column, or {1} and {2}",
                           job::name(map.kind), column, row, table_of(job)));
    }
    const CellIndex place{nearest(map.rows, row, values.at(row)),
                          nearest(map.columns, column, values.at(column))};
    return {place, values.at(column), values.at(row)};
}

// Whether a requested value differs from that of its cell by more than rounding.
bool is_beside(const Axis& axis, std::int64_t index, std::optional<double> asked) {
    if (!asked) return false;
    const double own = job::axis_value(axis, index);
    return std::abs(*asked - own) > 1e-9 * std::max(std::abs(*asked), std::abs(own));
}

// Distance of a requested place from its cell along one axis; "" if they agree up to rounding.
std::string distance_in_words(const Axis& axis, std::string_view key, std::int64_t index,
                              std::optional<double> asked, const job::CellNumbers& rig) {
    if (!is_beside(axis, index, asked)) return "";
    const double distance = std::abs(*asked - job::axis_value(axis, index));
    const std::string_view twin = job::twin_of(key);
    if (twin.empty()) return fmt::format("{:.3g} of {}", distance, key);
    const double in_si = job::is_in_si(key) ? distance : job::as_twin(key, distance, rig);
    if (key.find("frequency") != std::string_view::npos) return fmt::format("{:.3g} Hz", in_si);
    if (key.find("velocity") != std::string_view::npos) return fmt::format("{:.3g} m/s", in_si);
    return fmt::format("{:.3g} mm", 1000 * in_si);
}

std::string distance_in_words(const job::Job& map, const Named& named) {
    const job::CellNumbers rig = job::numbers_at(map, named.cell.row, named.cell.column);
    const std::string across =
        distance_in_words(map.columns, column_key(map), named.cell.column, named.column, rig);
    const std::string up = distance_in_words(map.rows, row_key(map), named.cell.row, named.row, rig);
    return across.empty() || up.empty() ? across + up : across + ", " + up;
}

// The job with the rig and the place of a map's cell, self-contained.
job::Job with_rig_of(const job::Job& job, const job::CellNumbers& numbers) {
    job::Job own = job;
    own.cell = {};
    own.hammer = numbers.hammer;
    own.cart = numbers.cart;
    own.contact = numbers.contact;
    own.operating_point = numbers.place;
    return own;
}

// A trace follows a cell as it was computed, or the same rig at the requested place.
job::Job trace_of_cell(const job::Job& job, const job::Job& map, const Named& named) {
    const CellIndex& cell = named.cell;
    job::CellNumbers numbers = job::numbers_at(map, cell.row, cell.column);
    if (is_beside(map.columns, cell.column, named.column))
        job::set_number(numbers, column_key(map), *named.column);
    if (is_beside(map.rows, cell.row, named.row)) job::set_number(numbers, row_key(map), *named.row);
    job::Job own = with_rig_of(map, numbers);
    own.kind = job::Kind::trace;
    own.title = job.title.empty() ? map.title : job.title;
    own.trace = job.trace;
    own.output.anonymous = job.output.anonymous;
    own.columns = own.rows = {};
    own.start = numbers.start;
    // the rules of a trace apply to it, and whatever belongs only to a plane is dropped
    return job::read_job_text(job::resolved_text(own), job.cell.map);
}

// The rig of a cell, at the requested place; all else is the basin's own.
job::Job basin_of_cell(const job::Job& job, const job::Job& map, const Named& named, const std::string& rig) {
    job::CellNumbers numbers = job::numbers_at(map, named.cell.row, named.cell.column);
    if (named.column) job::set_number(numbers, column_key(map), *named.column);
    if (named.row) job::set_number(numbers, row_key(map), *named.row);
    return job::read_job_text(job::resolved_text(with_rig_of(job, numbers)),
                              fmt::format("this basin with the rig of {}", rig));
}

// What names a cell: its row and column, or the requested place.
std::string named_in_words(const job::Job& job, const Named& named) {
    const std::string& file = job.cell.map;
    if (!named.column) return fmt::format("row {}, column {} of {}", named.cell.row, named.cell.column, file);
    std::string text = file;
    for (const auto& [key, value] : job.cell.values) {
        text += fmt::format("{} {} = {:.9g}", text == file ? " at" : ",", key, value);
    }
    return text;
}

}  // namespace

TracedCell find_traced_cell(const job::Job& job) {
    if (job.cell.map.empty()) return {job, std::nullopt, std::nullopt};
    const std::string key = fmt::format("{}.map", table_of(job));
    const job::Job map = map_file::read_map_job(job.cell.map, key);
    const bool is_basin = job.kind == job::Kind::basin;
    if (is_basin && map.kind != job::Kind::map) {
        refuse(
            fmt::format("{} = \"{}\" is itself a basin; its rig and place are in the job of that file; give "
                        "the file of a map",
                        key, job.cell.map));
    }
    const Named named = cell_of(job, map);
    const std::string rig = named_in_words(job, named);
    if (is_basin) return {basin_of_cell(job, map, named, rig), rig, std::nullopt};
    TracedCell traced{trace_of_cell(job, map, named), rig,
                      map_file::read_map_cell(job.cell.map, map, named.cell.row, named.cell.column)};
    traced.map->asked_beside = distance_in_words(map, named);
    return traced;
}

}  // namespace peterka
