// The samples of a close view of an impact.
#include "trace/impact_window.hpp"

#include <gtest/gtest.h>

namespace peterka::trace {
namespace {

TEST(ImpactWindow, PlacesItsShareOfSamplesBeforeTheTouch) {
    const WindowPlan plan = plan_window(3, 10, 1, 0.5, 5, 20);
    EXPECT_EQ(plan.step, 0.25);
    EXPECT_EQ(plan.before, 2);
    EXPECT_EQ(plan.after, 3);
    EXPECT_EQ(plan_window(0, 10, 1, 1, 5, 20).before, 4);
    EXPECT_EQ(plan_window(0, 10, 1, 0, 5, 20).before, 0);
}

TEST(ImpactWindow, EndsWithTheTrace) {
    EXPECT_EQ(plan_window(0, 0.3, 1, 0.5, 5, 20).before, 1);
    EXPECT_EQ(plan_window(0, 10, 1, 0.5, 5, 10.3).after, 2);
}

}  // namespace
}  // namespace peterka::trace
