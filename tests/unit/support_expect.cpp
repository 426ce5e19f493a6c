// Preconditions between functions are checked in builds for testing.
#include "support/expect.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "batch/batched_cycle_map.hpp"
#include "parallel/tile_pool.hpp"
#include "rig.hpp"

namespace peterka {
namespace {

#ifndef PETERKA_EXPECTS
#error "tests are built without what they are to look at"
#endif

TEST(Expect, TellsWhatWasExpectedAndWhere) {
    const int slot = 3;
    PETERKA_EXPECT(slot == 3);
    try {
        PETERKA_EXPECT(slot < 3);
        FAIL() << "three is taken for less than three";
    } catch (const std::logic_error& error) {
        const std::string words = error.what();
        EXPECT_NE(words.find("support_expect.cpp:"), std::string::npos) << words;
        EXPECT_NE(words.find("expected slot < 3"), std::string::npos) << words;
    }
}

// At the entry points of the kernel and of dealing.
TEST(Expect, StandsAtDoors) {
    batch::BatchedCycleMap map(testing::paper_rig(testing::beam_170mm, 1, 0), 2);
    map.add(2, 0.5, {-1, 0});
    map.advance();
    EXPECT_NO_THROW((void)map.cycle(0));
    EXPECT_THROW((void)map.cycle(1), std::logic_error);
    EXPECT_THROW(map.remove(1), std::logic_error);
    EXPECT_THROW(map.add(0, 0.5, {-1, 0}), std::logic_error);
    EXPECT_THROW(map.add(testing::paper_rig(testing::beam_170mm, 2, 0), {-1, 0}), std::logic_error);
    EXPECT_NO_THROW((void)parallel::deal_size(5, 5, 1));
    EXPECT_THROW((void)parallel::deal_size(6, 5, 1), std::logic_error);
    EXPECT_THROW((void)parallel::deal_size(5, 5, 0), std::logic_error);
}

}  // namespace
}  // namespace peterka
