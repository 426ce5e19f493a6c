#include "support/latest.hpp"

#include <gtest/gtest.h>

namespace peterka {
namespace {

TEST(Latest, HasTheLastOfManyInTheirOrder) {
    Latest<int> latest(3);
    EXPECT_EQ(latest.capacity(), 3U);
    EXPECT_TRUE(latest.values().empty());
    latest.add(1);
    latest.add(2);
    EXPECT_EQ(latest.values(), (std::vector{1, 2}));
    for (int value = 3; value <= 11; ++value) {
        latest.add(value);
        EXPECT_EQ(latest.values(), (std::vector{value - 2, value - 1, value}));
    }
    latest.clear();
    EXPECT_TRUE(latest.values().empty());
    latest.add(12);
    EXPECT_EQ(latest.values(), std::vector{12});
}

}  // namespace
}  // namespace peterka
