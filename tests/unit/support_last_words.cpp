// However the program ends, it reports why.
#include "support/last_words.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <new>
#include <stdexcept>
#include <string>

#include "support/errors.hpp"

namespace peterka {
namespace {

constexpr int internal = static_cast<int>(ExitCode::internal);

void where_nothing_may_be_thrown(void (*task)()) noexcept {
    task();
}

TEST(LastWords, MemoryThatRunsOutWhereNobodyCatches) {
    EXPECT_EXIT(where_nothing_may_be_thrown([] { throw std::bad_alloc(); }),
                ::testing::ExitedWithCode(internal), "^peterka: out of memory\\. Run the same command again");
}

TEST(LastWords, AnotherExceptionThatNobodyCatches) {
    EXPECT_EXIT(where_nothing_may_be_thrown([] { throw std::logic_error("surprise"); }),
                ::testing::ExitedWithCode(internal),
                "^peterka: internal error: an exception that nobody catches");
}

TEST(LastWords, ALibraryThatEndsTheProgram) {
    EXPECT_EXIT(
        {
            const LastWords last_words;
            std::exit(255);
        },
        ::testing::ExitedWithCode(internal), "^peterka: a library ended the program");
}

TEST(LastWords, TheProgramEndsItself) {
    EXPECT_EXIT(
        {
            { const LastWords last_words; }
            std::exit(5);
        },
        ::testing::ExitedWithCode(5), "^$");
    EXPECT_EXIT(
        {
            const LastWords last_words;
            LastWords::are_said();
            std::exit(3);
        },
        ::testing::ExitedWithCode(3), "^$");
}

TEST(LastWords, OfAnExceptionThatIsCaught) {
    EXPECT_EQ(as_failure(std::bad_alloc()).code(), ExitCode::internal);
    EXPECT_TRUE(std::string(as_failure(std::bad_alloc()).what()).starts_with("out of memory. "));
    EXPECT_STREQ(as_failure(Failure(ExitCode::output, "the disk is full")).what(), "the disk is full");
    EXPECT_EQ(as_failure(Failure(ExitCode::output, "the disk is full")).code(), ExitCode::output);
    EXPECT_NE(std::string(as_failure(std::logic_error("surprise")).what()).find("internal error: surprise."),
              std::string::npos);
}

}  // namespace
}  // namespace peterka
