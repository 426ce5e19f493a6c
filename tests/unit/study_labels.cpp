// What a run says of a cell.
#include "study/labels.hpp"

#include <gtest/gtest.h>

namespace peterka::study {
namespace {

TEST(Labels, AreProvedUnlessUnresolvedOrFailed) {
    using regime::Regime;
    for (const Regime regime :
         {Regime::no_impact, Regime::periodic, Regime::chaotic, Regime::sustained_contact}) {
        EXPECT_TRUE(Labels::Result{.regime = regime}.is_proved());
    }
    EXPECT_FALSE(Labels::Result{.regime = Regime::unresolved}.is_proved());
    EXPECT_FALSE(Labels::Result{.regime = Regime::failed}.is_proved());
}

}  // namespace
}  // namespace peterka::study
