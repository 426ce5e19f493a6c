// A file's record of the arithmetic that made it: all that affects the last bits, and no more.
#include "map_file/arithmetic.hpp"

#include <gtest/gtest.h>

#include <regex>
#include <string>

#include "batch/cycle_kernel.hpp"

namespace peterka::map_file {
namespace {

TEST(MapFileArithmetic, NamesProcessorLibraryAndVectors) {
    EXPECT_TRUE(std::regex_match(
        arithmetic(), std::regex("(x86-64|aarch64|ppc64|riscv|other), libm [0-9a-f]{8}, vectors (fma|plain)")))
        << arithmetic();
    EXPECT_TRUE(arithmetic().ends_with(", vectors " + std::string(batch::arithmetic()))) << arithmetic();
}

// glibc releases from 2.36 on give identical results: measured for 20 million arguments of each function.
#if defined(__x86_64__) && defined(__GLIBC__) && __GLIBC_PREREQ(2, 36)
TEST(MapFileArithmetic, IsOneForReleasesThatComputeTheSame) {
    if (__builtin_cpu_supports("fma") == 0) GTEST_SKIP() << "the library computes otherwise without fma";
    EXPECT_TRUE(arithmetic().find("libm c54f924d") != std::string::npos) << arithmetic();
}
#endif

}  // namespace
}  // namespace peterka::map_file
