#include "map_file/make_layout.hpp"

#include <fmt/format.h>
#include <hdf5_hl.h>

#include <algorithm>
#include <functional>
#include <map>
#include <numeric>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hdf5/attributes.hpp"
#include "hdf5/block.hpp"
#include "job/axis.hpp"
#include "job/axis_quantity.hpp"
#include "job/twins.hpp"

namespace peterka::map_file {

namespace {

// Bounds the memory for any number of points.
constexpr std::int64_t values_at_once = 65536;

// Without times, two files of one map have the same bytes in their headers too.
void leave_out_times(const hdf5::Checked& check, const hdf5::PropertiesId& properties) {
    check(H5Pset_obj_track_times(properties.id(), false), "H5Pset_obj_track_times");
}

hdf5::PropertiesId new_properties(const hdf5::Checked& check, hid_t kind) {
    return hdf5::PropertiesId(check(H5Pcreate(kind), "H5Pcreate"));
}

hdf5::SpaceId space_of(const hdf5::Checked& check, const DatasetPlan& plan) {
    if (plan.dimensions.empty()) return hdf5::SpaceId(check(H5Screate(H5S_SCALAR), "H5Screate"));
    std::vector<hsize_t> sizes;
    for (const Dimension& dimension : plan.dimensions) sizes.push_back(static_cast<hsize_t>(dimension.size));
    return hdf5::SpaceId(
        check(H5Screate_simple(static_cast<int>(sizes.size()), sizes.data(), nullptr), "H5Screate_simple"));
}

hdf5::PropertiesId creation_of(const hdf5::Checked& check, const DatasetPlan& plan) {
    hdf5::PropertiesId properties = new_properties(check, H5P_DATASET_CREATE);
    leave_out_times(check, properties);
    const bool is_last = plan.path() == path::bytes;
    check(H5Pset_alloc_time(properties.id(), is_last ? H5D_ALLOC_TIME_LATE : H5D_ALLOC_TIME_EARLY),
          "H5Pset_alloc_time");
    check(H5Pset_fill_time(properties.id(), H5D_FILL_TIME_ALLOC), "H5Pset_fill_time");
    if (plan.variable.number != hdf5::Number::text) {
        check(H5Pset_fill_value(properties.id(), H5T_NATIVE_DOUBLE, &plan.variable.fill), "H5Pset_fill_value");
    }
    if (plan.is_tiled()) {
        const std::vector<hsize_t> sizes(plan.chunk.begin(), plan.chunk.end());
        check(H5Pset_chunk(properties.id(), static_cast<int>(sizes.size()), sizes.data()), "H5Pset_chunk");
    }
    return properties;
}

void describe(const hdf5::Checked& check, hid_t dataset, const hdf5::Variable& variable) {
    hdf5::write_attribute(check, dataset, "long_name", variable.long_name);
    if (*variable.units != '\0') hdf5::write_attribute(check, dataset, "units", variable.units);
    if (variable.flags.empty()) return;
    std::vector<std::int32_t> values(variable.flags.size());
    std::iota(values.begin(), values.end(), variable.first_flag);
    std::string meanings;
    for (const char* name : variable.flags) meanings += (meanings.empty() ? "" : " ") + std::string(name);
    if (variable.number == hdf5::Number::int32) {
        hdf5::write_attribute(check, dataset, "flag_values", std::span<const std::int32_t>(values));
    } else {  // CF requires them in the variable's own type
        const std::vector<std::int8_t> small(values.begin(), values.end());
        hdf5::write_attribute(check, dataset, "flag_values", std::span<const std::int8_t>(small));
    }
    hdf5::write_attribute(check, dataset, "flag_meanings", meanings);
    hdf5::write_attribute(
        check, dataset, "comment",
        fmt::format("{}: none, as of what isn't computed yet or an empty slot", variable.fill));
}

hdf5::DatasetId make_dataset(const hdf5::Checked& check, hid_t file, const DatasetPlan& plan) {
    hdf5::DatasetId dataset(
        check(H5Dcreate2(file, plan.path().c_str(), hdf5::file_type(check, plan.variable.number).id(),
                         space_of(check, plan).id(), H5P_DEFAULT, creation_of(check, plan).id(), H5P_DEFAULT),
              "H5Dcreate2"));
    describe(check, dataset.id(), plan.variable);
    return dataset;
}

void make_group(const hdf5::Checked& check, hid_t file, const std::string& path) {
    const hdf5::PropertiesId properties = new_properties(check, H5P_GROUP_CREATE);
    leave_out_times(check, properties);
    const hdf5::GroupId group(
        check(H5Gcreate2(file, path.c_str(), H5P_DEFAULT, properties.id(), H5P_DEFAULT), "H5Gcreate2"));
}

// Known beforehand: scales, and the definition of a sweep's branches.
bool is_coordinate(const DatasetPlan& plan) {
    return plan.is_scale() || (plan.group == "/" && plan.dimensions.size() == 1);
}

using ValueAt = std::function<double(std::int64_t i)>;

// Values of an axis or of the branches, in either unit.
ValueAt value_of(std::string_view name, const job::Job& job) {
    const auto is = [&](std::string_view key) { return job::quantity(key).coordinate == name; };
    const auto in_either = [&](std::string_view key, const std::optional<job::Twin>& twin,
                               const ValueAt& own) -> ValueAt {
        if (is(key)) return own;
        if (twin && is(twin->key)) return [own, twin](std::int64_t i) { return twin->value(own(i)); };
        return nullptr;
    };
    const auto along = [](const job::Axis& axis) {
        return [&axis](std::int64_t i) { return job::axis_value(axis, i); };
    };
    if (auto found = in_either(column_key(job), job::twin_of_columns(job), along(job.columns))) return found;
    if (job.kind != job::Kind::sweep) return in_either(row_key(job), job::twin_of_rows(job), along(job.rows));
    return in_either(job.sweep.gap_key(), job::twin_of_branches(job),
                     [&job](std::int64_t i) { return job.sweep.branch(i).gap.value(); });
}

// Values of an axis or of the branches, or the number of a tile, a sample or a table row.
ValueAt value_of(const DatasetPlan& plan, const job::Job& job) {
    if (plan.group == "/") {
        if (auto found = value_of(plan.variable.name, job)) return found;
        if (!plan.is_scale())
            return [&job](std::int64_t i) { return static_cast<double>(job.sweep.branch(i).direction); };
    }
    return [](std::int64_t i) { return static_cast<double>(i); };
}

// Passes on the coordinates of a dataset in parts, each with its block.
template <class Use>
void each_part(const DatasetPlan& plan, const job::Job& job, Use&& use) {
    const std::int64_t size = plan.dimensions[0].size;
    const ValueAt value = value_of(plan, job);
    for (std::int64_t first = 0; first < size; first += values_at_once) {
        const hdf5::Block block(first, std::min(values_at_once, size - first));
        std::vector<double> values(*block.count());
        for (std::int64_t i = 0; i < std::ssize(values); ++i) {
            values[static_cast<std::size_t>(i)] = value(first + i);
        }
        use(block, values);
    }
}

}  // namespace

hdf5::PropertiesId file_access(const hdf5::Checked& check) {
    hdf5::PropertiesId access = new_properties(check, H5P_FILE_ACCESS);
    // The format of HDF5 1.10 keeps no index if all chunks are allocated: nothing to update, nothing to lose.
    check(H5Pset_libver_bounds(access.id(), H5F_LIBVER_V110, H5F_LIBVER_V110), "H5Pset_libver_bounds");
    // Objects one after the other instead of in blocks, of which some would stay half empty: sizes add up
    // exactly.
    check(H5Pset_meta_block_size(access.id(), 0), "H5Pset_meta_block_size");
    check(H5Pset_small_data_block_size(access.id(), 0), "H5Pset_small_data_block_size");
    // Writes reach the file at once, and reads come from it.
    check(H5Pset_cache(access.id(), 0, 0, 0, 0), "H5Pset_cache");
    check(H5Pset_sieve_buf_size(access.id(), 0), "H5Pset_sieve_buf_size");
    // Not every file system can lock, and a reader that holds a lock must not stop a run.
    check(H5Pset_file_locking(access.id(), false, true), "H5Pset_file_locking");
    return access;
}

hdf5::PropertiesId file_creation(const hdf5::Checked& check) {
    hdf5::PropertiesId creation = new_properties(check, H5P_FILE_CREATE);
    leave_out_times(check, creation);
    check(H5Pset_link_creation_order(creation.id(), H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED),
          "H5Pset_link_creation_order");
    check(H5Pset_attr_creation_order(creation.id(), H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED),
          "H5Pset_attr_creation_order");
    return creation;
}

void make_datasets(const hdf5::Checked& check, hid_t file, std::span<const DatasetPlan> plans) {
    std::map<std::string, hdf5::DatasetId> scales;
    std::string group = "/";
    for (const DatasetPlan& plan : plans) {
        if (plan.group != group) make_group(check, file, group = plan.group);
        hdf5::DatasetId dataset = make_dataset(check, file, plan);
        if (plan.is_scale()) {
            check(H5DSset_scale(dataset.id(), plan.variable.name), "H5DSset_scale");
            scales[group + plan.variable.name] = std::move(dataset);
            continue;
        }
        for (unsigned i = 0; i < plan.dimensions.size(); ++i) {
            check(H5DSattach_scale(dataset.id(), scales.at(group + plan.dimensions[i].name).id(), i),
                  "H5DSattach_scale");
        }
    }
    check(H5Fflush(file, H5F_SCOPE_LOCAL), "H5Fflush");  // attribute heaps take their space
    hdf5::write_text(check, file, path::bytes, "");      // and this dataset its own, after all else
}

void write_coordinates(const hdf5::Checked& check, hid_t file, std::span<const DatasetPlan> plans,
                       const job::Job& job) {
    for (const DatasetPlan& plan : plans) {
        if (!is_coordinate(plan)) continue;
        const hdf5::DatasetId dataset(check(H5Dopen2(file, plan.path().c_str(), H5P_DEFAULT), "H5Dopen2"));
        each_part(plan, job, [&](const hdf5::Block& block, const std::vector<double>& values) {
            hdf5::write_block(check, dataset.id(), hdf5::Number::float64, block, values.data());
        });
    }
}

// Values of a logarithmic axis differ in their last bits from one mathematical library to another.
static bool same_coordinate(double stored, double expected) {
    return std::abs(stored - expected) <= 1e-13 * std::abs(expected);
}

bool holds_coordinates(const hdf5::Checked& check, hid_t file, const DatasetPlan& plan, const job::Job& job) {
    if (!is_coordinate(plan)) return true;
    const hdf5::DatasetId dataset(check(H5Dopen2(file, plan.path().c_str(), H5P_DEFAULT), "H5Dopen2"));
    bool equal = true;
    each_part(plan, job, [&](const hdf5::Block& block, const std::vector<double>& expected) {
        std::vector<double> values(expected.size());
        hdf5::read_block(check, dataset.id(), hdf5::Number::float64, block, values.data());
        equal = equal && std::ranges::equal(values, expected, same_coordinate);
    });
    return equal;
}

}  // namespace peterka::map_file
