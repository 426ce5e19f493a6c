#include "output/matches_plan.hpp"

#include <algorithm>
#include <vector>

#include "output/hdf5.hpp"

namespace peterka::output {

namespace {

bool exists(hid_t file, const DatasetPlan& plan) {
    if (plan.group != "/" && H5Lexists(file, plan.group.c_str(), H5P_DEFAULT) <= 0) return false;
    return H5Lexists(file, plan.path().c_str(), H5P_DEFAULT) > 0;
}

bool has_type(const Checked& check, const DatasetId& dataset, Number number) {
    const TypeId type(check(H5Dget_type(dataset.id()), "H5Dget_type"));
    return H5Tequal(type.id(), file_type(check, number).id()) > 0;
}

bool has_size(const Checked& check, const DatasetId& dataset, const std::vector<Dimension>& dimensions) {
    const SpaceId space(check(H5Dget_space(dataset.id()), "H5Dget_space"));
    const int rank = check(H5Sget_simple_extent_ndims(space.id()), "H5Sget_simple_extent_ndims");
    if (rank != static_cast<int>(dimensions.size())) return false;
    std::vector<hsize_t> sizes(dimensions.size());
    check(H5Sget_simple_extent_dims(space.id(), sizes.data(), nullptr), "H5Sget_simple_extent_dims");
    return std::ranges::equal(sizes, dimensions, {}, {},
                              [](const Dimension& dimension) { return static_cast<hsize_t>(dimension.size); });
}

// Space that is not allocated would change metadata when written: such a file could not survive a kill.
bool is_allocated(const Checked& check, const DatasetId& dataset, const DatasetPlan& plan) {
    const PropertiesId properties(check(H5Dget_create_plist(dataset.id()), "H5Dget_create_plist"));
    const H5D_layout_t wanted = plan.is_tiled() ? H5D_CHUNKED : H5D_CONTIGUOUS;
    if (H5Pget_layout(properties.id()) != wanted) return false;
    if (plan.is_tiled()) {
        std::vector<hsize_t> sizes(plan.chunk.size());
        check(H5Pget_chunk(properties.id(), static_cast<int>(sizes.size()), sizes.data()), "H5Pget_chunk");
        if (sizes != std::vector<hsize_t>(plan.chunk.begin(), plan.chunk.end())) return false;
    }
    return H5Dget_storage_size(dataset.id()) == static_cast<hsize_t>(plan.bytes());
}

}  // namespace

bool matches_plan(const Checked& check, hid_t file, const DatasetPlan& plan) {
    if (!exists(file, plan)) return false;
    const DatasetId dataset(H5Dopen2(file, plan.path().c_str(), H5P_DEFAULT));  // a group of that name fails
    if (dataset.id() < 0) return false;
    return has_type(check, dataset, plan.variable.number) && has_size(check, dataset, plan.dimensions) &&
           is_allocated(check, dataset, plan);
}

}  // namespace peterka::output
