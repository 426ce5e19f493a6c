#include "map_file/output_lock.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "map_examples.hpp"
#include "support/errors.hpp"

namespace peterka::map_file {
namespace {

using examples::Folder;

TEST(OutputLock, KeepsASecondRunOut) {
    const Folder folder;
    const OutputLock first(folder / "map.h5");
    try {
        const OutputLock second(folder / "map.h5", std::chrono::milliseconds(100));
        FAIL() << "the second got in";
    } catch (const Failure& failure) {
        EXPECT_EQ(failure.code(), ExitCode::output);
        EXPECT_NE(std::string(failure.what()).find("map.h5: is being written by another run (process "),
                  std::string::npos);
    }
    const OutputLock other_file(folder / "other.h5");
}

TEST(OutputLock, EndsWithItsOwnerAndLeavesNothing) {
    const Folder folder;
    {
        OutputLock first(folder / "map.h5");
        const OutputLock moved(std::move(first));
        EXPECT_EQ(folder.names(), std::vector<std::string>{"map.h5.peterka-lock"});
    }
    EXPECT_TRUE(folder.names().empty());
    const OutputLock again(folder / "map.h5");
}

TEST(OutputLock, AFileLeftBehindByAKillStopsNobody) {
    const Folder folder;
    std::ofstream(folder / "map.h5.peterka-lock") << "peterka runs as process 1 on nowhere";
    EXPECT_NO_THROW(OutputLock(folder / "map.h5"));
}

TEST(OutputLock, WhatNoRunHasPutThereIsRefusedAndStays) {
    const Folder folder;
    examples::write_content(folder / "map.h5.peterka-lock", "a poem");
    EXPECT_THROW(OutputLock lock(folder / "map.h5"), Failure);
    EXPECT_EQ(examples::content_of(folder / "map.h5.peterka-lock"), "a poem");
    std::filesystem::remove(folder / "map.h5.peterka-lock");
    examples::write_content(folder / "victim", "");
    std::filesystem::create_symlink(folder / "victim", folder / "map.h5.peterka-lock");
    EXPECT_THROW(OutputLock lock(folder / "map.h5"), Failure);
    std::filesystem::remove(folder / "map.h5.peterka-lock");
    std::filesystem::create_hard_link(folder / "victim", folder / "map.h5.peterka-lock");
    EXPECT_THROW(OutputLock lock(folder / "map.h5"), Failure);
    EXPECT_EQ(examples::content_of(folder / "victim"), "");
}

TEST(OutputLock, TheFileItselfIsLockedUnderAnyName) {
    const Folder folder;
    examples::write_content(folder / "map.h5", "");
    std::filesystem::create_hard_link(folder / "map.h5", folder / "alias.h5");
    {
        const FileLock first(folder / "map.h5");
        EXPECT_THROW(FileLock second(folder / "alias.h5", std::chrono::milliseconds(100)), Failure);
    }
    const FileLock again(folder / "alias.h5");
    EXPECT_EQ(again.lacking(), "");
}

TEST(OutputLock, AFolderThatIsNotThereIsNotItsAffair) {
    const Folder folder;
    EXPECT_NO_THROW(OutputLock(folder / "missing/map.h5"));
}

}  // namespace
}  // namespace peterka::map_file
