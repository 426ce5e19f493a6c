#include "map_file/matches_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <set>
#include <utility>
#include <vector>

#include "hdf5/hdf5.hpp"
#include "hdf5/storage.hpp"
#include "hdf5/versions.hpp"

namespace peterka::map_file {

namespace {

bool has_type(const hdf5::Checked& check, const hdf5::DatasetId& dataset, hdf5::Number number) {
    const hdf5::TypeId type(check(H5Dget_type(dataset.id()), "H5Dget_type"));
    return H5Tequal(type.id(), hdf5::file_type(check, number).id()) > 0;
}

bool has_size(const hdf5::Checked& check, const hdf5::DatasetId& dataset,
              const std::vector<Dimension>& dimensions) {
    const hdf5::SpaceId space(check(H5Dget_space(dataset.id()), "H5Dget_space"));
    const int rank = check(H5Sget_simple_extent_ndims(space.id()), "H5Sget_simple_extent_ndims");
    if (rank != static_cast<int>(dimensions.size())) return false;
    std::vector<hsize_t> sizes(dimensions.size());
    check(H5Sget_simple_extent_dims(space.id(), sizes.data(), nullptr), "H5Sget_simple_extent_dims");
    return std::ranges::equal(sizes, dimensions, {}, {},
                              [](const Dimension& dimension) { return static_cast<hsize_t>(dimension.size); });
}

bool has_chunks(const hdf5::Checked& check, const hdf5::DatasetId& dataset, const DatasetPlan& plan) {
    if (!plan.is_tiled()) return true;
    const hdf5::PropertiesId properties(check(H5Dget_create_plist(dataset.id()), "H5Dget_create_plist"));
    if (H5Pget_layout(properties.id()) != H5D_CHUNKED) return false;
    std::vector<hsize_t> sizes(plan.chunk.size());
    if (H5Pget_chunk(properties.id(), static_cast<int>(sizes.size()), sizes.data()) != std::ssize(sizes))
        return false;
    return sizes == std::vector<hsize_t>(plan.chunk.begin(), plan.chunk.end());
}

hdf5::ObjectIdentity identity_of(const hdf5::Checked& check, hid_t object) {
    hdf5::ObjectInfo info;
    check(hdf5::get_object_info(object, ".", &info, H5O_INFO_BASIC), "H5Oget_info_by_name");
    return hdf5::identity_of(info);
}

// The objects and storage seen so far, to verify that no two share anything.
class Taken {
  public:
    [[nodiscard]] bool take_object(const hdf5::ObjectIdentity& object) {
        return objects_.insert(object).second;
    }
    void take_storage(const std::string& path, const hdf5::Storage& storage) {
        ranges_.push_back({storage.begin(), storage.end(), path});
    }
    // What is wrong unless all storage is disjoint and inside a file of this size.
    [[nodiscard]] std::optional<std::string> fault(std::uint64_t file_size) {
        std::ranges::sort(ranges_, {}, &ByteSpan::begin);
        std::uint64_t free_from = 1;  // the file begins with its superblock
        for (const ByteSpan& range : ranges_) {
            if (range.begin < free_from || range.end > file_size)
                return fmt::format("dataset {} has no storage of its own in the file", range.path);
            free_from = range.end;
        }
        return std::nullopt;
    }

  private:
    struct ByteSpan {
        std::uint64_t begin;
        std::uint64_t end;
        std::string path;
    };
    std::set<hdf5::ObjectIdentity> objects_;
    std::vector<ByteSpan> ranges_;
};

bool takes_group(const hdf5::Checked& check, hid_t file, const std::string& path, Taken& taken) {
    if (!is_own_link(file, path)) return false;
    const hdf5::GroupId group(H5Gopen2(file, path.c_str(), H5P_DEFAULT));
    return group.id() >= 0 && taken.take_object(identity_of(check, group.id()));
}

bool takes_dataset(const hdf5::Checked& check, hid_t file, const DatasetPlan& plan, Taken& taken) {
    if (!is_own_link(file, plan.path())) return false;
    const hdf5::DatasetId dataset(
        H5Dopen2(file, plan.path().c_str(), H5P_DEFAULT));  // a group of that name fails
    if (dataset.id() < 0 || !taken.take_object(identity_of(check, dataset.id()))) return false;
    if (!has_type(check, dataset, plan.variable.number) || !has_size(check, dataset, plan.dimensions) ||
        !has_chunks(check, dataset, plan)) {
        return false;
    }
    const auto storage = hdf5::Storage::of(check, dataset.id());
    if (!storage || storage->is_chunked() != plan.is_tiled() ||
        storage->end() - storage->begin() != static_cast<std::uint64_t>(plan.bytes())) {
        return false;
    }
    taken.take_storage(plan.path(), *storage);
    return true;
}

// Whether a dataset is the planned one but for its chunks, as in maps with [noise] until 2026-11-28.
bool has_other_tiles(const hdf5::Checked& check, hid_t file, const DatasetPlan& plan) {
    if (!plan.is_tiled() || !is_own_link(file, plan.path())) return false;
    const hdf5::DatasetId dataset(H5Dopen2(file, plan.path().c_str(), H5P_DEFAULT));
    return dataset.id() >= 0 && has_type(check, dataset, plan.variable.number) &&
           has_size(check, dataset, plan.dimensions) && !has_chunks(check, dataset, plan);
}

}  // namespace

bool is_own_link(hid_t file, const std::string& path) {
    for (std::size_t end = path.find('/', 1);; end = path.find('/', end + 1)) {
        H5L_info_t info;
        const std::string part = path.substr(0, end);
        if (H5Lget_info(file, part.c_str(), &info, H5P_DEFAULT) < 0 || info.type != H5L_TYPE_HARD) return false;
        if (end == std::string::npos) return true;
    }
}

std::optional<std::string> layout_fault(const hdf5::Checked& check, hid_t file, const job::Job& job) {
    Taken taken;
    std::string group = "/";
    for (const DatasetPlan& plan : layout(job)) {
        if (plan.group != group && !takes_group(check, file, group = plan.group, taken))
            return fmt::format("group {} is missing or not its own", plan.group);
        if (!takes_dataset(check, file, plan, taken)) {
            return fmt::format("dataset {} is {}", plan.path(),
                               has_other_tiles(check, file, plan) ? "in other tiles than this program's"
                                                                  : "missing or not of its kind");
        }
    }
    return taken.fault(std::filesystem::file_size(check.path()));
}

}  // namespace peterka::map_file
