// Written data are read back from the disk: if they differ, they are written once more, or the run ends.
#include "hdf5/stored.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <string>

#include "map_examples.hpp"
#include "map_file/make_file.hpp"
#include "map_file/make_layout.hpp"
#include "support/errors.hpp"

namespace peterka::hdf5 {
namespace {

namespace examples = map_file::examples;

constexpr std::array<double, 8> written{1, 2, 3, 4, 5, 6, 7, 8};
constexpr const char* dataset = "/frequency_ratio";

class HDF5Stored : public testing::Test {
  protected:
    HDF5Stored() {
        map_file::make_file(path_, examples::small_map(4, 8), examples::made_by());
        file_ =
            FileId(check_(H5Fopen(path_.c_str(), H5F_ACC_RDWR, map_file::file_access(check_).id()), "H5Fopen"));
    }

    // HDF5 writes to the map, and the data are read back from this file.
    void write_with(const DiskFile& disk) const {
        Stored(OpenMap{check_, file_.id(), disk}, dataset, Number::float64).write(Block(0, 8), written.data());
    }
    [[nodiscard]] std::array<double, 8> numbers_on(const DiskFile& disk) const {
        std::array<double, 8> numbers{};
        Stored(OpenMap{check_, file_.id(), disk}, dataset, Number::float64).read(Block(0, 8), numbers.data());
        return numbers;
    }

    examples::Folder folder_;
    std::filesystem::path path_ = folder_ / "map.h5";
    Checked check_{path_};
    FileId file_;
};

TEST_F(HDF5Stored, NumbersComeBackFromTheDisk) {
    const DiskFile disk(path_);
    write_with(disk);
    EXPECT_EQ(numbers_on(disk), written);
}

// As if HDF5's own write had been lost: it went to a copy of the file.
TEST_F(HDF5Stored, WhatTheDiskDoesNotHoldIsWrittenOnceMore) {
    std::filesystem::copy_file(path_, folder_ / "copy.h5");
    const DiskFile disk(folder_ / "copy.h5");
    ASSERT_NE(numbers_on(disk), written);
    write_with(disk);
    EXPECT_EQ(numbers_on(disk), written);
}

// Accepts all writes, and returns zeros.
TEST_F(HDF5Stored, ADiskThatForgetsEndsTheRun) {
    const DiskFile disk("/dev/zero");
    try {
        write_with(disk);
        FAIL() << "what isn't there was taken for written";
    } catch (const Failure& failure) {
        EXPECT_EQ(failure.code(), ExitCode::output);
        EXPECT_NE(std::string(failure.what()).find("/frequency_ratio doesn't hold what was just written"),
                  std::string::npos)
            << failure.what();
    }
}

}  // namespace
}  // namespace peterka::hdf5
