#include "job/rules.hpp"

#include <gtest/gtest.h>

namespace peterka::job {
namespace {

TEST(RuleOfACellOfAMap, WantsRowAndColumnTogether) {
    constexpr int none = -1;
    EXPECT_EQ(rule_of_cell_of_map({.map = "map.h5", .row = none, .column = none}, "basin"), "");
    EXPECT_EQ(rule_of_cell_of_map({.map = "map.h5", .row = 0, .column = 0}, "basin"), "");
    EXPECT_NE(rule_of_cell_of_map({.map = "map.h5", .row = 0, .column = none}, "basin"), "");
    EXPECT_NE(rule_of_cell_of_map({.map = "map.h5", .row = none, .column = 0}, "basin"), "");
    EXPECT_NE(rule_of_cell_of_map({.map = "", .row = 0, .column = none}, "basin"), "");
    EXPECT_NE(rule_of_cell_of_map({.map = "", .row = none, .column = 0}, "basin"), "");
}

}  // namespace
}  // namespace peterka::job
