// Truncated texts keep whole characters.
#include "support/whole_letters.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <iterator>
#include <string>

namespace peterka {
namespace {

TEST(WholeLetters, AreNeverCutInTwo) {
    const std::string text = "a\u00e9\u20ac\U0001d11eb";  // characters of 1, 2, 3, 4 and 1 bytes
    const std::size_t ends[] = {0, 1, 1, 3, 3, 3, 6, 6, 6, 6, 10, 11, 11, 11};
    ASSERT_EQ(text.size(), 11U);
    for (std::size_t longest = 0; longest < std::size(ends); ++longest) {
        EXPECT_EQ(whole_letters(text, longest), ends[longest]) << longest;
    }
    EXPECT_EQ(whole_letters("", 5), 0U);
}

}  // namespace
}  // namespace peterka
