// A file's record of the program that made it.
#include "map_file/provenance.hpp"

#include <gtest/gtest.h>

namespace peterka::map_file {
namespace {

TEST(OutputProvenance, NamesEveryVersion) {
    const Provenance made_by = collect_provenance();
    EXPECT_TRUE(made_by.hdf5.starts_with("1.") || made_by.hdf5.starts_with("2.")) << made_by.hdf5;
    EXPECT_FALSE(made_by.mpi.empty());
    EXPECT_EQ(made_by.mpi.find('\n'), std::string::npos);
    EXPECT_GE(made_by.sundials, "6.4");
    EXPECT_GE(made_by.eigen, "3.4");
    EXPECT_FALSE(made_by.fmt.empty());
    EXPECT_FALSE(made_by.program_version.empty());
    EXPECT_FALSE(made_by.git_commit.empty());
}

}  // namespace
}  // namespace peterka::map_file
