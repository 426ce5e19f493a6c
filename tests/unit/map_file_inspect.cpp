// Whatever exists at the map's path is recognised, and each fault is reported with its own reason.
#include "map_file/inspect.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstdint>
#include <string>

#include "inspected_map.hpp"

namespace peterka::map_file {
namespace {

class OutputInspect : public examples::InspectedMap {};

TEST_F(OutputInspect, NothingThere) {
    EXPECT_EQ(inspect(path_, job_), Existing::absent);
}

TEST_F(OutputInspect, EmptyMapIsResumable) {
    make();
    EXPECT_EQ(inspect(path_, job_), Existing::resumable);
}

TEST_F(OutputInspect, CompleteOnlyWithAllTilesAndFinished) {
    make();
    write_all_tiles();
    EXPECT_EQ(inspect(path_, job_), Existing::resumable);
    finish();
    EXPECT_EQ(inspect(path_, job_), Existing::complete);
    change([](const hdf5::Checked& check, hid_t file) {
        const hdf5::DatasetId done(check(H5Dopen2(file, path::done, H5P_DEFAULT), "H5Dopen2"));
        const std::int8_t no = 0;
        hdf5::write_block(check, done.id(), hdf5::Number::int8, hdf5::Block(3, 1), &no);
    });
    EXPECT_EQ(inspect(path_, job_), Existing::resumable);
}

TEST_F(OutputInspect, TitleAndLimitsDoNotMakeAnotherJob) {
    make();
    job_.title = "Another title";
    job_.limits.failed_cells = 99;
    EXPECT_EQ(inspect(path_, job_), Existing::resumable);
}

TEST_F(OutputInspect, Directory) {
    std::filesystem::create_directory(path_);
    expect_refused("is a directory");
}

TEST_F(OutputInspect, Socket) {
    ASSERT_EQ(mknod(path_.c_str(), S_IFSOCK | 0600, 0), 0);
    expect_refused("is not a regular file");
}

TEST_F(OutputInspect, EmptyFileAndRubbish) {
    examples::write_content(path_, "");
    expect_refused("is not an HDF5 file");
    examples::write_content(path_, std::string("\x7f\0\x01rubbish", 10));
    expect_refused("is not an HDF5 file");
}

TEST_F(OutputInspect, AnotherProgramsFile) {
    { const hdf5::FileId file(H5Fcreate(path_.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT)); }
    expect_refused("was not made by peterka");
}

TEST_F(OutputInspect, LayoutVersionOfAWrongType) {
    const hdf5::Checked check(path_);
    {
        const hdf5::FileId file(H5Fcreate(path_.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT));
        hdf5::write_attribute(check, file.id(), "peterka_layout", std::string("1"));
    }
    expect_refused("was not made by peterka");
}

TEST_F(OutputInspect, Truncated) {
    make();
    const auto size = std::filesystem::file_size(path_);
    std::filesystem::resize_file(path_, size - 1);
    expect_refused("is damaged: truncated file");
    std::filesystem::resize_file(path_, 1000);
    expect_refused("is damaged");
}

TEST_F(OutputInspect, AnotherLayoutVersion) {
    make();
    change([](const hdf5::Checked& check, hid_t file) {
        check(H5Adelete(file, "peterka_layout"), "H5Adelete");
        hdf5::write_attribute(check, file, "peterka_layout", layout_version + 1);
    });
    expect_refused("has layout version 4, this program writes version 3");
}

TEST_F(OutputInspect, AnotherJobIsToldByItsKeys) {
    make();
    job_.rows.points = 21;
    job_.hammer.mass_kg = 0.5;
    expect_refused("axes.gap_ratio.points: 20 in the file, 21 in the job");
    expect_refused("hammer.mass_kg: 0.298 in the file, 0.5 in the job");
    try {
        (void)inspect(path_, job_);
    } catch (const Failure& failure) {
        EXPECT_EQ(std::string(failure.what()).find("frequency_ratio"), std::string::npos) << failure.what();
    }
}

TEST_F(OutputInspect, MissingDataset) {
    make();
    change([](const hdf5::Checked& check, hid_t file) {
        check(H5Ldelete(file, "/cycles", H5P_DEFAULT), "H5Ldelete");
    });
    expect_refused("dataset /cycles is missing or not of its kind");
}

TEST_F(OutputInspect, MissingGroup) {
    make();
    change([](const hdf5::Checked& check, hid_t file) {
        check(H5Ldelete(file, "/tiles", H5P_DEFAULT), "H5Ldelete");
    });
    expect_refused("group /tiles is missing");
}

TEST_F(OutputInspect, WrongType) {
    make();
    replace_dataset(path::checksum, H5T_IEEE_F64LE, {4});
    expect_refused("dataset /tiles/checksum is missing or not of its kind");
}

TEST_F(OutputInspect, WrongSize) {
    make();
    replace_dataset(path::checksum, H5T_STD_U64LE, {3});
    expect_refused("dataset /tiles/checksum is missing or not of its kind");
}

TEST_F(OutputInspect, WrongRank) {
    make();
    replace_dataset(path::checksum, H5T_STD_U64LE, {2, 2});
    expect_refused("dataset /tiles/checksum is missing or not of its kind");
}

TEST_F(OutputInspect, WrongCoordinates) {
    make();
    change([](const hdf5::Checked& check, hid_t file) {
        const hdf5::DatasetId axis(check(H5Dopen2(file, "/gap_ratio", H5P_DEFAULT), "H5Dopen2"));
        const double wrong = 1e9;
        hdf5::write_block(check, axis.id(), hdf5::Number::float64, hdf5::Block(7, 1), &wrong);
    });
    expect_refused("dataset /gap_ratio has values that are not the job's");
}

TEST_F(OutputInspect, ManyNumbersInPlaceOfOne) {
    make();
    replace_dataset(path::finished, H5T_IEEE_F64LE, {4000});
    expect_refused("dataset /summary/finished is missing or not of its kind");
    EXPECT_THROW((void)holds_complete_map(path_), Failure);
}

TEST_F(OutputInspect, NotInTiles) {
    make();
    replace_dataset("/cycles", H5T_STD_I32LE, {20, 20});
    expect_refused("dataset /cycles is in other tiles than this program's");
}

TEST_F(OutputInspect, GroupInPlaceOfADataset) {
    make();
    change([](const hdf5::Checked& check, hid_t file) {
        check(H5Ldelete(file, "/cycles", H5P_DEFAULT), "H5Ldelete");
        const hdf5::GroupId group(
            check(H5Gcreate2(file, "/cycles", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), "H5Gcreate2"));
    });
    expect_refused("dataset /cycles is missing or not of its kind");
}

TEST_F(OutputInspect, AnythingChangedAfterTheSealIsFound) {
    make();
    write_all_tiles();
    finish();
    EXPECT_EQ(inspect(path_, job_), Existing::complete);
    change([](const hdf5::Checked& check, hid_t file) {
        check(H5Adelete(file, "natural_frequency_hz"), "H5Adelete");
        hdf5::write_attribute(check, file, "natural_frequency_hz", 45.0);
    });
    expect_refused("is damaged: something outside its cells is not what it was");
    finish();
    change([](const hdf5::Checked& check, hid_t file) {
        hdf5::write_text(check, file, path::omitted, "nothing");
    });
    expect_refused("is damaged: something outside its cells is not what it was");
    finish();
    EXPECT_EQ(inspect(path_, job_), Existing::complete);
}

TEST_F(OutputInspect, OtherArithmeticCannotBeResumedButIsCompleteOnceComplete) {
    make();
    write_all_tiles();
    change([](const hdf5::Checked& check, hid_t file) {
        check(H5Adelete(file, "arithmetic"), "H5Adelete");
        hdf5::write_attribute(check, file, "arithmetic", std::string("abacus"));
    });
    expect_refused("was computed with other arithmetic (abacus;");
    finish();
    EXPECT_EQ(inspect(path_, job_), Existing::complete);
}

class OtherSundials : public OutputInspect {
  protected:
    void SetUp() override {
        Provenance other = examples::made_by();
        other.sundials = "5.0.0";
        make_file(path_, job_, other);
    }

    void write_tile(cell::Engine engine) {
        change([&](const hdf5::Checked& check, hid_t file) {
            const hdf5::DiskFile disk(path_);
            TileStore store({check, file, disk}, job_);
            const parallel::Tile tile = store.tiling().tile(1);
            std::vector<quantities::StoredCell> cells = examples::made_up_stored_cells(tile);
            cells.back().engine = engine;
            store.write(tile, cells, {});
        });
    }
};

TEST_F(OtherSundials, ConcernsOnlyCellsThatItCarried) {
    EXPECT_EQ(inspect(path_, job_), Existing::resumable);
    write_tile(cell::Engine::split);
    EXPECT_EQ(inspect(path_, job_), Existing::resumable);
    for (const auto engine : {cell::Engine::cvode, cell::Engine::arkode}) {
        write_tile(engine);
        expect_refused("was computed with another release of SUNDIALS (5.0.0;");
        write_tile(cell::Engine::exact);
        EXPECT_EQ(inspect(path_, job_), Existing::resumable);
    }
}

}  // namespace
}  // namespace peterka::map_file
