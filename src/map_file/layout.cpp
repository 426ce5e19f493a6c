#include "map_file/layout.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <limits>
#include <optional>
#include <string_view>
#include <utility>

#include "job/axis_quantity.hpp"
#include "job/branches.hpp"
#include "job/twins.hpp"
#include "map_file/audit_table.hpp"
#include "map_file/cell_attractors.hpp"
#include "map_file/samples.hpp"
#include "quantities/fields.hpp"

namespace peterka::map_file {

namespace {

// In the order of job::Direction.
constexpr std::array<const char*, 3> direction_names{"up", "down", "independent"};

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// clang-format off
constexpr hdf5::Variable frequency_ratio{"frequency_ratio", hdf5::Number::float64, nan, "1", "excitation frequency over natural frequency, Omega/omega"};
constexpr hdf5::Variable gap_ratio{"gap_ratio", hdf5::Number::float64, nan, "1", "gap over cart amplitude, gap/A0"};
constexpr hdf5::Variable displacement_ratio{"displacement_ratio", hdf5::Number::float64, nan, "1", "hammer displacement at the start over cart amplitude, x(0)/A0"};
constexpr hdf5::Variable velocity_ratio{"velocity_ratio", hdf5::Number::float64, nan, "1", "hammer velocity at the start over A0 omega, x'(0)/(A0 omega)"};
constexpr hdf5::Variable branch{"branch", hdf5::Number::int32, -1, "1", "branch: a gap and a direction of the sweep"};
constexpr hdf5::Variable sample{"sample", hdf5::Number::int32, -1, "1", "sample of the steady motion"};
constexpr hdf5::Variable direction{"direction", hdf5::Number::int8, regime::regime_not_computed, "", "order of the frequencies: each point starts from the last one's motion, or all alike", direction_names};
constexpr hdf5::Variable attractor_of_cell{"attractor", hdf5::Number::int32, -1, "1", "row of the table in group attractors; -1 for none"};

constexpr hdf5::Variable tile{"tile", hdf5::Number::int64, 0, "1", "tile number, row by row"};
constexpr hdf5::Variable tile_variables[] = {
    {"done", hdf5::Number::int8, 0, "1", "1 once the tile and its checksum are written"},
    {"checksum", hdf5::Number::uint64, 0, "", "XXH3 (64 bits) of the tile: field after field, row by row"},
};
constexpr hdf5::Variable run_tile_variables[] = {
    {"tile_seconds", hdf5::Number::float64, nan, "s", "computing time of the tile"},
    {"tile_rank", hdf5::Number::int32, -1, "1", "rank that computed the tile"},
};
constexpr hdf5::Variable run_variables[] = {
    {"ranks", hdf5::Number::int32, 0, "1", "ranks of the last run"},
    {"compute_seconds", hdf5::Number::float64, 0, "s", "wall time of all runs of this file"},
    {"solve_seconds", hdf5::Number::float64, 0, "s", "of these, solving and storing cells, without starting up"},
    {"hosts", hdf5::Number::text, 0, "", "hosts of the last run"},
};
constexpr hdf5::Variable summary_variables[] = {
    {"omitted", hdf5::Number::text, 0, "", "what the program left out of the scene and why"},
    {"failures", hdf5::Number::text, 0, "", "cells without a result and why"},
    {"frame", hdf5::Number::uint64, 0, "", "XXH3 (64 bits) of what the file has from the beginning"},
    checksum_of_file,
    {"finished", hdf5::Number::int8, 0, "1", "1 once everything in the file is final"},
};
constexpr hdf5::Variable attractor_slot{"attractor", hdf5::Number::int32, -1, "1", "attractor of a cell, those with the largest shares first"};
constexpr hdf5::Variable outcome_slot{"outcome", hdf5::Number::int32, -1, "1", "outcome of a cell with uncertain rigs, the most likely first"};
constexpr hdf5::Variable attractor_row{"attractor", hdf5::Number::int32, -1, "1", "row of this table"};
constexpr hdf5::Variable attractor_cells{"cells", hdf5::Number::int64, 0, "1", "cells that lead to the attractor"};
constexpr hdf5::Variable attractor_count{"count", hdf5::Number::int32, 0, "1", "rows in use"};
// clang-format on
constexpr const char* point_attractor =
    "attractor that the branch is on at the point; -1 for none of those that are kept";

parallel::Extent largest_tile(const job::Job& job) {
    if (job.kind != job::Kind::sweep)
        return job.noise.any() ? parallel::tile_extent_of_lives : parallel::tile_extent;
    const bool share_a_point = job.starts.count > 0 || job.uncertainty.rigs > 0;
    return {share_a_point ? job::branches_of_a_gap(job.sweep) : 1, job.columns.points};
}

// On the plane of cells, with the samples of each as an optional third dimension.
DatasetPlan on_cells(const job::Job& job, const hdf5::Variable& variable, std::vector<Dimension> dimensions) {
    const parallel::Extent largest = largest_tile(job);
    std::vector<std::int64_t> chunk{std::min(largest.rows, dimensions[0].size),
                                    std::min(largest.columns, dimensions[1].size)};
    if (dimensions.size() > 2) chunk.push_back(dimensions[2].size);
    return {"/", variable, std::move(dimensions), std::move(chunk)};
}

// Several values per cell: consecutive planes, cut into the same tiles.
template <class Field>
void add_slots(std::vector<DatasetPlan>& plans, const job::Job& job, const std::vector<Field>& fields,
               const hdf5::Variable& slot, std::int64_t kept, const Dimension& rows, const Dimension& columns) {
    if (fields.empty()) return;
    const Dimension slots{slot.name, kept};
    plans.push_back({"/", slot, {slots}});
    for (const Field& field : fields) {
        std::vector<std::int64_t> chunk = on_cells(job, field.variable, {rows, columns}).chunk;
        chunk.insert(chunk.begin(), slots.size);
        plans.push_back({"/", field.variable, {slots, rows, columns}, std::move(chunk)});
    }
}

void add_attractors_and_outcomes(std::vector<DatasetPlan>& plans, const job::Job& job, const Dimension& rows,
                                 const Dimension& columns) {
    add_slots(plans, job, quantities::stored_attractor_fields(job), attractor_slot, job.starts.attractors, rows,
              columns);
    add_slots(plans, job, quantities::stored_outcome_fields(job), outcome_slot, cell::kept_outcomes, rows,
              columns);
}

// The coordinate in the other unit, beside the coordinate itself.
void add_twin(std::vector<DatasetPlan>& plans, const job::Job& job, const Dimension& along,
              const std::optional<job::Twin>& twin) {
    if (twin && job.layout > 2) plans.push_back({"/", coordinate_of(twin->key), {along}});
}

void add_branches(std::vector<DatasetPlan>& plans, const job::Job& job) {
    const Dimension branches{branch.name, job.row_count()};
    const hdf5::Variable axis = coordinate_of(column_key(job));
    const Dimension along{axis.name, job.columns.points};
    const Dimension samples{sample.name, job.sweep.samples};
    plans.push_back({"/", branch, {branches}});
    plans.push_back({"/", axis, {along}});
    plans.push_back({"/", sample, {samples}});
    add_twin(plans, job, along, job::twin_of_columns(job));
    if (!job.sweep.gaps().empty()) plans.push_back({"/", coordinate_of(job.sweep.gap_key()), {branches}});
    add_twin(plans, job, branches, job::twin_of_branches(job));
    plans.push_back({"/", direction, {branches}});
    for (const quantities::Field& field : quantities::stored_fields(job)) {
        hdf5::Variable variable = field.variable;
        // a point of a branch starts where the one before ended
        if (std::string_view(variable.name) == "start_attractor") variable.long_name = point_attractor;
        plans.push_back(on_cells(job, variable, {branches, along}));
    }
    add_attractors_and_outcomes(plans, job, branches, along);
    for (const hdf5::Variable& variable : stored_sample_variables(job)) {
        plans.push_back(on_cells(job, variable, {branches, along, samples}));
    }
}

void add_plane(std::vector<DatasetPlan>& plans, const job::Job& job) {
    const bool is_map = job.kind == job::Kind::map;
    const hdf5::Variable columns = coordinate_of(column_key(job));
    const hdf5::Variable rows = coordinate_of(row_key(job));
    const Dimension column_dimension{columns.name, job.columns.points};
    const Dimension row_dimension{rows.name, job.rows.points};
    plans.push_back({"/", columns, {column_dimension}});
    plans.push_back({"/", rows, {row_dimension}});
    add_twin(plans, job, column_dimension, job::twin_of_columns(job));
    add_twin(plans, job, row_dimension, job::twin_of_rows(job));
    for (const quantities::Field& field : quantities::stored_fields(job)) {
        plans.push_back(on_cells(job, field.variable, {row_dimension, column_dimension}));
    }
    add_attractors_and_outcomes(plans, job, row_dimension, column_dimension);
    if (!is_map) plans.push_back(on_cells(job, attractor_of_cell, {row_dimension, column_dimension}));
}

void add_attractors(std::vector<DatasetPlan>& plans) {
    const Dimension dimension{attractor_row.name, attractor_capacity};
    plans.push_back({"/attractors", attractor_row, {dimension}});
    for (const quantities::Field& field : quantities::attractor_fields())
        plans.push_back({"/attractors", field.variable, {dimension}});
    plans.push_back({"/attractors", attractor_cells, {dimension}});
    plans.push_back({"/attractors", attractor_count, {}});
}

void add_tiles_and_run(std::vector<DatasetPlan>& plans, const job::Job& job) {
    const Dimension dimension{tile.name, tiling(job).count()};
    plans.push_back({"/tiles", tile, {dimension}});
    for (const hdf5::Variable& variable : tile_variables) plans.push_back({"/tiles", variable, {dimension}});
    plans.push_back({"/run", tile, {dimension}});
    for (const hdf5::Variable& variable : run_tile_variables) plans.push_back({"/run", variable, {dimension}});
    for (const hdf5::Variable& variable : run_variables) plans.push_back({"/run", variable, {}});
    std::ranges::move(audit_run_plans(job), std::back_inserter(plans));
}

std::int64_t capped_product(std::int64_t a, std::int64_t b) {
    std::int64_t product = 0;
    return __builtin_mul_overflow(a, b, &product) ? std::numeric_limits<std::int64_t>::max() : product;
}

}  // namespace

hdf5::Variable coordinate_of(std::string_view key) {
    for (const hdf5::Variable& usual : {frequency_ratio, gap_ratio, displacement_ratio, velocity_ratio}) {
        if (key == usual.name) return usual;
    }
    const job::AxisQuantity& over = job::quantity(key);
    return {over.coordinate.c_str(), hdf5::Number::float64, nan, over.units.c_str(), over.long_name.c_str()};
}

std::string DatasetPlan::path() const {
    return (group == "/" ? "" : group) + "/" + variable.name;
}

bool DatasetPlan::is_scale() const {
    return dimensions.size() == 1 && dimensions[0].name == variable.name;
}

std::int64_t DatasetPlan::bytes() const {
    auto size = static_cast<std::int64_t>(hdf5::bytes_of(variable.number));
    for (std::size_t i = 0; i < dimensions.size(); ++i) {
        // tiles at the edge take the space of a whole one
        const std::int64_t side = is_tiled() ? chunk[i] : 1;
        size = capped_product(size, (dimensions[i].size + side - 1) / side * side);
    }
    return size;
}

std::vector<DatasetPlan> layout(const job::Job& job) {
    std::vector<DatasetPlan> plans;
    job.kind == job::Kind::sweep ? add_branches(plans, job) : add_plane(plans, job);
    if (job.kind == job::Kind::basin) add_attractors(plans);
    add_tiles_and_run(plans, job);
    std::ranges::move(audit_plans(job), std::back_inserter(plans));
    for (const hdf5::Variable& variable : summary_variables) plans.push_back({"/summary", variable, {}});
    if (job.layout > 2) plans.push_back({"/summary", record_of_bytes, {}});
    return plans;
}

parallel::Tiling tiling(const job::Job& job) {
    return parallel::Tiling({job.row_count(), job.columns.points}, largest_tile(job));
}

}  // namespace peterka::map_file
