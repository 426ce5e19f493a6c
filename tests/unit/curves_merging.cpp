// Whether the halves of an orbit change places in a step, for orbits made up by hand.
#include "curves/merging.hpp"

#include <gtest/gtest.h>

#include "rig.hpp"

namespace peterka::curves {
namespace {

class Halves : public ::testing::Test {
  protected:
    Rig rig_{testing::paper_rig(testing::beam_170mm, 2, 0.5)};
    PlanePoint place_{2, 0.5};
    Stepper stepper_{rig_, {4, 5}, {}};
    double half_ = rig_.at(place_).duration_of(1);

    // Of two impacts, the second half a period after the first but for `later`, and faster by `faster`.
    [[nodiscard]] OrbitPoint orbit(double later, double faster) const {
        return {{2, {{EventKind::touch, true, 0, 1}, {EventKind::touch, true, half_ + later, 1 + faster}}},
                place_};
    }
};

TEST_F(Halves, MeetWhereTheirDifferenceTurnsRound) {
    EXPECT_TRUE(halves_meet(stepper_, orbit(0.1, 0), orbit(-0.01, 0)));
    EXPECT_TRUE(halves_meet(stepper_, orbit(0.1, 0.2), orbit(0.05, -0.3)));
    EXPECT_TRUE(halves_meet(stepper_, orbit(0.1, 0), orbit(0, 0)));  // it ends on the merged orbit
}

TEST_F(Halves, DoNotMeetWhereTheirDifferenceKeepsItsSense) {
    EXPECT_FALSE(halves_meet(stepper_, orbit(0.1, 0.2), orbit(0.01, 0.02)));
    EXPECT_FALSE(halves_meet(stepper_, orbit(0.1, 0), orbit(0, 0.3)));  // a right angle
    EXPECT_FALSE(halves_meet(stepper_, orbit(0, 0), orbit(-0.1, 0)));   // of an orbit followed twice over
}

}  // namespace
}  // namespace peterka::curves
