#include "support/folder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace peterka {
namespace {

TEST(Folder, NamesAllEntriesButItselfAndTheOneAbove) {
    const std::filesystem::path folder = std::filesystem::path(::testing::TempDir()) / "peterka_folder";
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder / "inner");
    for (const char* name : {"a.toml", ".hidden", "a name with spaces"}) std::ofstream(folder / name).flush();
    std::vector<std::string> names = names_in(folder);
    std::ranges::sort(names);
    EXPECT_EQ(names, (std::vector<std::string>{".hidden", "a name with spaces", "a.toml", "inner"}));
    std::filesystem::remove_all(folder);
    EXPECT_TRUE(names_in(folder).empty());
}

}  // namespace
}  // namespace peterka
