// Untrusted contents in place of a map's datasets are refused.
#include <gtest/gtest.h>

#include <functional>

#include "inspected_map.hpp"

namespace peterka::map_file {
namespace {

// A run would write through any foreign object in place of a dataset.
class OutputStrangersMap : public examples::InspectedMap {
  protected:
    void replace(const std::function<void(const hdf5::Checked&, hid_t)>& put) {
        make();
        change([&](const hdf5::Checked& check, hid_t file) {
            check(H5Ldelete(file, path::checksum, H5P_DEFAULT), "H5Ldelete");
            put(check, file);
        });
        expect_refused("dataset /tiles/checksum is missing or not of its kind");
    }

    static void create(const hdf5::Checked& check, hid_t file, hid_t properties) {
        constexpr hsize_t size = 4;
        const hdf5::SpaceId space(check(H5Screate_simple(1, &size, nullptr), "H5Screate_simple"));
        const hdf5::DatasetId made(check(
            H5Dcreate2(file, path::checksum, H5T_STD_U64LE, space.id(), H5P_DEFAULT, properties, H5P_DEFAULT),
            "H5Dcreate2"));
    }
};

TEST_F(OutputStrangersMap, LinkToAnotherFile) {
    replace([](const hdf5::Checked& check, hid_t file) {
        check(H5Lcreate_external("victim.h5", "/sums", file, path::checksum, H5P_DEFAULT, H5P_DEFAULT), "link");
    });
}

TEST_F(OutputStrangersMap, SoftLink) {
    replace([](const hdf5::Checked& check, hid_t file) {
        check(H5Lcreate_soft("/tiles/tile", file, path::checksum, H5P_DEFAULT, H5P_DEFAULT), "link");
    });
}

TEST_F(OutputStrangersMap, StorageInAnotherFile) {
    replace([&](const hdf5::Checked& check, hid_t file) {
        const hdf5::PropertiesId properties(check(H5Pcreate(H5P_DATASET_CREATE), "H5Pcreate"));
        check(H5Pset_external(properties.id(), (folder_ / "victim").c_str(), 0, 32), "H5Pset_external");
        create(check, file, properties.id());
    });
}

TEST_F(OutputStrangersMap, VirtualDataset) {
    replace([&](const hdf5::Checked& check, hid_t file) {
        constexpr hsize_t size = 4;
        const hdf5::SpaceId space(check(H5Screate_simple(1, &size, nullptr), "H5Screate_simple"));
        const hdf5::PropertiesId properties(check(H5Pcreate(H5P_DATASET_CREATE), "H5Pcreate"));
        check(H5Pset_virtual(properties.id(), space.id(), "victim.h5", "/sums", space.id()), "H5Pset_virtual");
        create(check, file, properties.id());
    });
}

TEST_F(OutputStrangersMap, OneObjectUnderTwoNames) {
    make();
    change([](const hdf5::Checked& check, hid_t file) {
        check(H5Ldelete(file, "/period", H5P_DEFAULT), "H5Ldelete");
        check(H5Lcreate_hard(file, "/impacts", file, "/period", H5P_DEFAULT, H5P_DEFAULT), "H5Lcreate_hard");
    });
    expect_refused("dataset /period is missing or not of its kind");
}

TEST_F(OutputStrangersMap, GroupBehindALink) {
    make();
    change([](const hdf5::Checked& check, hid_t file) {
        check(H5Lmove(file, "/tiles", file, "/elsewhere", H5P_DEFAULT, H5P_DEFAULT), "H5Lmove");
        check(H5Lcreate_soft("/elsewhere", file, "/tiles", H5P_DEFAULT, H5P_DEFAULT), "link");
    });
    expect_refused("group /tiles is missing or not its own");
}

}  // namespace
}  // namespace peterka::map_file
