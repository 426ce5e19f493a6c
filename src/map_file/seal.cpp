#include "map_file/seal.hpp"

#include <fmt/format.h>
#include <hdf5_hl.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "hdf5/hdf5.hpp"
#include "hdf5/stored.hpp"
#include "hdf5/versions.hpp"
#include "map_file/layout.hpp"
#include "map_file/matches_plan.hpp"
#include "map_file/sum.hpp"
#include "support/errors.hpp"

namespace peterka::map_file {

namespace {

struct Names {
    std::vector<std::string> all;

    static herr_t take_link(hid_t, const char* name, const H5L_info_t*, void* names) {
        static_cast<Names*>(names)->all.emplace_back(name);
        return 0;
    }
    static herr_t take_attribute(hid_t, const char* name, const H5A_info_t*, void* names) {
        const std::string_view own = name;
        if (own != "DIMENSION_LIST" && own != "REFERENCE_LIST")
            static_cast<Names*>(names)->all.emplace_back(name);
        return 0;
    }
    static herr_t take_scale(hid_t, unsigned, hid_t scale, void* names) {
        const auto length = H5Iget_name(scale, nullptr, 0);
        if (length < 0) return -1;
        std::string path(static_cast<std::size_t>(length), '\0');
        H5Iget_name(scale, path.data(), path.size() + 1);
        static_cast<Names*>(names)->all.push_back(path);
        return 0;
    }
};

class Sealing {
  public:
    Sealing(const hdf5::Checked& check, hid_t file, const hdf5::DiskFile* disk, Sealed part)
        : check_(check), file_(file), disk_(disk), part_(part) {}

    [[nodiscard]] std::uint64_t value() {
        add_group("/");
        return sum_.value();
    }

  private:
    [[noreturn]] void refuse_part(const std::string& path, const char* why) const {
        throw Failure(ExitCode::output, fmt::format("{}: is damaged, or was not made by peterka: {} {}",
                                                    check_.path().string(), path, why));
    }

    void add_group(const std::string& path) {
        const hdf5::GroupId group(check_(H5Gopen2(file_, path.c_str(), H5P_DEFAULT), "H5Gopen2"));
        sum_.add("group");
        sum_.add(path);
        add_attributes(group.id(), path);
        Names names;
        check_(H5Literate(group.id(), H5_INDEX_NAME, H5_ITER_NATIVE, nullptr, Names::take_link, &names),
               "H5Literate");
        std::ranges::sort(names.all);
        for (const std::string& name : names.all) {
            const std::string child = (path == "/" ? "" : path) + "/" + name;
            if (child != "/run") add_object(child);
        }
    }

    void add_object(const std::string& path) {
        if (!is_own_link(file_, path)) refuse_part(path, "is not an object of its own");
        hdf5::ObjectInfo info;
        check_(hdf5::get_object_info(file_, path.c_str(), &info, H5O_INFO_BASIC), "H5Oget_info_by_name");
        if (info.type == H5O_TYPE_GROUP) return add_group(path);
        if (info.type != H5O_TYPE_DATASET) refuse_part(path, "is neither a group nor a dataset");
        add_dataset(path);
    }

    void add_attributes(hid_t object, const std::string& path) {
        Names names;
        check_(H5Aiterate2(object, H5_INDEX_NAME, H5_ITER_NATIVE, nullptr, Names::take_attribute, &names),
               "H5Aiterate2");
        std::ranges::sort(names.all);
        sum_.add(std::uint64_t{names.all.size()});
        for (const std::string& name : names.all) {
            const hdf5::AttributeId attribute(check_(H5Aopen(object, name.c_str(), H5P_DEFAULT), "H5Aopen"));
            const hdf5::TypeId type(check_(H5Aget_type(attribute.id()), "H5Aget_type"));
            const hdf5::SpaceId space(check_(H5Aget_space(attribute.id()), "H5Aget_space"));
            const std::string kind = kind_of(type.id(), path);
            sum_.add(name);
            sum_.add(kind);
            const std::uint64_t values = add_shape(space.id(), path);
            if (kind == "text") {
                if (values != 1) refuse_part(path, "has a list of texts as attribute");
                add_text(attribute.id(), type.id());
                continue;
            }
            if (H5Aget_storage_size(attribute.id()) != values * H5Tget_size(type.id()))
                refuse_part(path, "has an attribute that is not all there");
            std::vector<std::byte> bytes(values * H5Tget_size(type.id()));
            check_(H5Aread(attribute.id(), type.id(), bytes.data()), "H5Aread");
            sum_.add(bytes);
        }
    }

    void add_text(hid_t attribute, hid_t type) {
        char* text = nullptr;
        check_(H5Aread(attribute, type, static_cast<void*>(&text)), "H5Aread");
        sum_.add(std::string_view(text == nullptr ? "" : text));
        H5free_memory(text);
    }

    [[nodiscard]] std::string kind_of(hid_t type, const std::string& path) const {
        const H5T_class_t kind = H5Tget_class(type);
        const std::size_t size = H5Tget_size(type);
        if (kind == H5T_STRING) return H5Tis_variable_str(type) > 0 ? "text" : fmt::format("S{}", size);
        const bool is_number = (kind == H5T_INTEGER || kind == H5T_FLOAT) && size <= 8;
        if (!is_number || (size > 1 && H5Tget_order(type) != H5T_ORDER_LE))
            refuse_part(path, "has a type that no file of peterka has");
        if (kind == H5T_FLOAT) return fmt::format("f{}", size);
        return fmt::format("{}{}", H5Tget_sign(type) == H5T_SGN_NONE ? 'u' : 'i', size);
    }

    // Returns the number of values.
    std::uint64_t add_shape(hid_t space, const std::string& path) {
        if (H5Sget_simple_extent_type(space) == H5S_NULL) refuse_part(path, "holds nothing");
        const int rank = check_(H5Sget_simple_extent_ndims(space), "H5Sget_simple_extent_ndims");
        std::vector<hsize_t> sizes(static_cast<std::size_t>(rank));
        check_(H5Sget_simple_extent_dims(space, sizes.data(), nullptr), "H5Sget_simple_extent_dims");
        sum_.add(std::uint64_t{sizes.size()});
        for (const hsize_t size : sizes) sum_.add(std::uint64_t{size});
        return static_cast<std::uint64_t>(H5Sget_simple_extent_npoints(space));
    }

    void add_dataset(const std::string& path) {
        const hdf5::DatasetId dataset(check_(H5Dopen2(file_, path.c_str(), H5P_DEFAULT), "H5Dopen2"));
        const hdf5::TypeId type(check_(H5Dget_type(dataset.id()), "H5Dget_type"));
        const hdf5::SpaceId space(check_(H5Dget_space(dataset.id()), "H5Dget_space"));
        sum_.add("dataset");
        sum_.add(path);
        add_attributes(dataset.id(), path);
        sum_.add(kind_of(type.id(), path));
        const std::uint64_t values = add_shape(space.id(), path);
        const int rank = H5Sget_simple_extent_ndims(space.id());
        for (unsigned i = 0; i < static_cast<unsigned>(rank); ++i) add_scales(dataset.id(), i);
        const bool is_coordinate = rank == 1 && path.rfind('/') == 0;
        if (path == path::sum_of_file || path == path::finished || path == path::bytes) return;
        if (part_ == Sealed::frame && !is_coordinate) return;
        disk_ == nullptr ? add_from_memory(dataset.id(), type.id(), values) : add_from_disk(dataset.id(), path);
    }

    void add_scales(hid_t dataset, unsigned dimension) {
        Names names;
        check_(H5DSiterate_scales(dataset, dimension, nullptr, Names::take_scale, &names),
               "H5DSiterate_scales");
        sum_.add(std::uint64_t{names.all.size()});
        for (const std::string& name : names.all) sum_.add(name);
    }

    void add_from_memory(hid_t dataset, hid_t type, std::uint64_t values) {
        std::vector<std::byte> bytes(values * H5Tget_size(type));
        check_(H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data()), "H5Dread");
        sum_.add(bytes);
    }

    void add_from_disk(hid_t dataset, const std::string& path) {
        const auto storage = hdf5::Storage::of(check_, dataset);
        if (!storage || storage->end() > disk_->size())
            refuse_part(path, "has no storage of its own in the file");
        if (storage->is_chunked() && path != path::attractor) return;
        std::vector<std::byte> room;
        constexpr std::size_t at_once = 1 << 20;
        storage->each_piece([&](std::uint64_t offset, std::size_t bytes) {
            room.resize(std::min(at_once, bytes));
            for (std::size_t done = 0; done < bytes; done += room.size()) {
                const std::span part(room.data(), std::min(room.size(), bytes - done));
                disk_->read(offset + done, part);
                sum_.add(part);
            }
        });
    }

    const hdf5::Checked& check_;
    hid_t file_;
    const hdf5::DiskFile* disk_;
    Sealed part_;
    Sum sum_;
};

const char* place_of(Sealed part) {
    return part == Sealed::whole ? path::sum_of_file : path::sum_of_frame;
}

}  // namespace

std::uint64_t seal_of(const hdf5::Checked& check, hid_t file, const hdf5::DiskFile* disk, Sealed part) {
    return Sealing(check, file, disk, part).value();
}

void write_seal(const hdf5::Checked& check, hid_t file, Sealed part) {
    const std::uint64_t sum = seal_of(check, file, nullptr, part);
    const hdf5::DatasetId dataset(check(H5Dopen2(file, place_of(part), H5P_DEFAULT), "H5Dopen2"));
    check(H5Dwrite(dataset.id(), H5T_NATIVE_UINT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, &sum), "H5Dwrite");
}

bool says_finished(const hdf5::Checked& check, hid_t file) {
    if (!is_own_link(file, path::finished)) return false;
    const hdf5::DiskFile disk(check.path());
    return hdf5::get_number({check, file, disk}, path::finished, hdf5::Number::int8) == 1;
}

bool is_sealed(const hdf5::Checked& check, hid_t file, Sealed part) {
    const hdf5::DiskFile disk(check.path());
    if (!is_own_link(file, place_of(part))) return false;
    std::uint64_t sum = 0;
    hdf5::Stored({check, file, disk}, place_of(part), hdf5::Number::uint64).read(hdf5::Block(0, 1), &sum);
    return sum == seal_of(check, file, &disk, part);
}

}  // namespace peterka::map_file
