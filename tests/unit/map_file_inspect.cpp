// Whatever lies where the map should be is recognised, and each wrong thing gets its own reason.
#include "map_file/inspect.hpp"

#include <gtest/gtest.h>
#include <hdf5_hl.h>
#include <sys/stat.h>

#include <functional>
#include <string>
#include <vector>

#include "hdf5/attributes.hpp"
#include "hdf5/block.hpp"
#include "hdf5/hdf5.hpp"
#include "map_examples.hpp"
#include "map_file/layout.hpp"
#include "map_file/make_file.hpp"
#include "map_file/make_layout.hpp"
#include "map_file/seal.hpp"
#include "map_file/tile_store.hpp"
#include "support/errors.hpp"

namespace peterka::map_file {
namespace {

using examples::Folder;

class OutputInspect : public testing::Test {
  protected:
    void make() { make_file(path_, job_, examples::made_by()); }

    void change(const std::function<void(const hdf5::Checked&, hid_t)>& task) {
        const hdf5::Checked check(path_);
        const hdf5::FileId file(
            check(H5Fopen(path_.c_str(), H5F_ACC_RDWR, file_access(check).id()), "H5Fopen"));
        task(check, file.id());
    }

    void write_all_tiles() {
        change([&](const hdf5::Checked& check, hid_t file) {
            const hdf5::DiskFile disk(path_);
            TileStore store({check, file, disk}, job_);
            for (std::int64_t i = 0; i < store.tiling().count(); ++i) {
                const parallel::Tile tile = store.tiling().tile(i);
                store.write(tile, examples::made_up_stored_cells(tile), {});
            }
        });
    }

    void finish() {
        change([&](const hdf5::Checked& check, hid_t file) {
            const hdf5::DiskFile disk(path_);
            const std::uint64_t sum = seal_of(check, file, &disk);
            hdf5::Stored({check, file, disk}, path::sum_of_file, hdf5::Number::uint64)
                .write(hdf5::Block(0, 1), &sum);
            hdf5::write_number(check, file, path::finished, 1);
        });
    }

    void expect_refused(const std::string& reason) {
        try {
            (void)inspect(path_, job_);
            ADD_FAILURE() << "was not refused: " << reason;
        } catch (const Failure& failure) {
            const std::string text = failure.what();
            EXPECT_EQ(failure.code(), ExitCode::output);
            EXPECT_NE(text.find(path_.string()), std::string::npos) << text;
            EXPECT_NE(text.find(reason), std::string::npos) << text;
        }
    }

    void replace_dataset(const char* name, hid_t type, const std::vector<hsize_t>& sizes) {
        change([&](const hdf5::Checked& check, hid_t file) {
            check(H5Ldelete(file, name, H5P_DEFAULT), "H5Ldelete");
            check(H5LTmake_dataset(file, name, static_cast<int>(sizes.size()), sizes.data(), type,
                                   std::vector<double>(4000).data()),
                  "H5LTmake_dataset");
        });
    }

    Folder folder_;
    std::filesystem::path path_ = folder_ / "map.h5";
    job::Job job_ = examples::small_map(20, 20);
};

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
    expect_refused("has layout version 3, this program writes version 2");
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
    expect_refused("dataset /cycles is missing or not of its kind");
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

// Whatever a stranger puts in the place of a dataset, a run would write through it.
class OutputStrangersMap : public OutputInspect {
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

}  // namespace
}  // namespace peterka::map_file
