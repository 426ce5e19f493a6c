// Creating a file: completely or not at all, and never over one that the same command cannot reproduce.
#include "map_file/make_file.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "hdf5/block.hpp"
#include "hdf5/hdf5.hpp"
#include "hdf5/versions.hpp"
#include "map_examples.hpp"
#include "map_file/inspect.hpp"
#include "map_file/layout.hpp"
#include "support/errors.hpp"

namespace peterka::map_file {
namespace {

using examples::content_of;
using examples::Folder;

void mark_finished(const std::filesystem::path& path) {
    const hdf5::Checked check(path);
    const hdf5::FileId file(check(H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT), "H5Fopen"));
    hdf5::write_number(check, file.id(), path::finished, 1);
}

TEST(OutputMakeFile, LeavesTheMapAlone) {
    const Folder folder;
    make_file(folder / "map.h5", examples::small_map(20, 4), examples::made_by());
    EXPECT_EQ(folder.names(), std::vector<std::string>{"map.h5"});
    EXPECT_FALSE(holds_complete_map(folder / "map.h5"));
}

TEST(OutputMakeFile, TwoFilesOfOneJobAreTheSameBytes) {
    const Folder folder;
    make_file(folder / "a.h5", examples::small_basin(20, 4), examples::made_by());
    make_file(folder / "b.h5", examples::small_basin(20, 4), examples::made_by());
    EXPECT_EQ(content_of(folder / "a.h5"), content_of(folder / "b.h5"));

    const hdf5::Checked check(folder / "a.h5");  // made within one second, they could hide the creation time
    const hdf5::FileId file(check(H5Fopen((folder / "a.h5").c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), "H5Fopen"));
    for (const char* object : {"/", "/tiles", "/attractors/regime", "/cycles"}) {
        hdf5::ObjectInfo info;
        check(hdf5::get_object_info(file.id(), object, &info, H5O_INFO_TIME), "H5Oget_info_by_name");
        EXPECT_EQ(info.ctime, 0) << object;
    }
}

TEST(OutputMakeFile, CompleteMapIsKeptUnderAnotherName) {
    const Folder folder;
    make_file(folder / "map.h5", examples::small_map(4, 4), examples::made_by());
    mark_finished(folder / "map.h5");
    const std::string before = content_of(folder / "map.h5");
    make_file(folder / "map.h5", examples::small_map(8, 8), examples::made_by());
    EXPECT_EQ(content_of(folder / "map.h5.peterka-previous"), before);
    EXPECT_EQ(inspect(folder / "map.h5", examples::small_map(8, 8)), Existing::resumable);
}

TEST(OutputMakeFile, UnfinishedMapIsReplacedAndAnOlderCompleteOneStays) {
    const Folder folder;
    make_file(folder / "map.h5", examples::small_map(4, 4), examples::made_by());
    mark_finished(folder / "map.h5");
    make_file(folder / "map.h5", examples::small_map(8, 8), examples::made_by());
    make_file(folder / "map.h5", examples::small_map(5, 5), examples::made_by());
    EXPECT_EQ(inspect(folder / "map.h5", examples::small_map(5, 5)), Existing::resumable);
    EXPECT_EQ(inspect(previous_name(folder / "map.h5"), examples::small_map(4, 4)), Existing::resumable)
        << "marked finished, but without tiles";
    EXPECT_TRUE(holds_complete_map(previous_name(folder / "map.h5")));
}

TEST(OutputMakeFile, WhatAKillLeftBehindIsReplaced) {
    const Folder folder;
    for (const std::string& begin :
         {std::string(), std::string(5000, '\0'), std::string("\x89HDF\r\n\x1a\nand some")}) {
        examples::write_content(temporary_name(folder / "map.h5"), begin);
        make_file(folder / "map.h5", examples::small_map(4, 4), examples::made_by());
        EXPECT_EQ(folder.names(), std::vector<std::string>{"map.h5"});
    }
}

TEST(OutputMakeFile, SomebodysFileUnderTheTemporaryNameStays) {
    const Folder folder;
    examples::write_content(temporary_name(folder / "map.h5"), "a poem");
    EXPECT_THROW(make_file(folder / "map.h5", examples::small_map(4, 4), examples::made_by()), Failure);
    EXPECT_EQ(content_of(temporary_name(folder / "map.h5")), "a poem");
    std::filesystem::remove(temporary_name(folder / "map.h5"));
    examples::write_content(folder / "victim", "");
    std::filesystem::create_symlink(folder / "victim", temporary_name(folder / "map.h5"));
    EXPECT_THROW(make_file(folder / "map.h5", examples::small_map(4, 4), examples::made_by()), Failure);
    EXPECT_EQ(content_of(folder / "victim"), "");
}

TEST(OutputMakeFile, SomebodysFileUnderTheNameOfThePreviousMapStays) {
    const Folder folder;
    make_file(folder / "map.h5", examples::small_map(4, 4), examples::made_by());
    mark_finished(folder / "map.h5");
    examples::write_content(previous_name(folder / "map.h5"), "a poem");
    const std::string before = content_of(folder / "map.h5");
    EXPECT_THROW(make_file(folder / "map.h5", examples::small_map(8, 8), examples::made_by()), Failure);
    remove_previous(folder / "map.h5");
    EXPECT_EQ(content_of(previous_name(folder / "map.h5")), "a poem");
    EXPECT_EQ(content_of(folder / "map.h5"), before);
}

TEST(OutputMakeFile, ForeignFileIsNotTouched) {
    const Folder folder;
    examples::write_content(folder / "thesis.pdf", "years of work");
    EXPECT_THROW(make_file(folder / "thesis.pdf", examples::small_map(4, 4), examples::made_by()), Failure);
    EXPECT_EQ(content_of(folder / "thesis.pdf"), "years of work");
    EXPECT_EQ(folder.names(), std::vector<std::string>{"thesis.pdf"});
}

}  // namespace
}  // namespace peterka::map_file
