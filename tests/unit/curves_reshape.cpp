#include "curves/reshape.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>

#include "rig.hpp"

namespace peterka::curves {
namespace {

class ToldLike : public ::testing::Test {
  protected:
    Rig rig_{testing::paper_rig(testing::beam_170mm, 2, 0.5)};
    PlanePoint place_{2, 0.5};
    double cycle_ = rig_.at(place_).duration_of(1);

    // Of two touches with their releases in three cycles, the first at `time`.
    [[nodiscard]] OrbitPoint orbit(double time) const {
        return {{3,
                 {{EventKind::touch, true, time, 2},
                  {EventKind::release, false, time + 0.1, -1},
                  {EventKind::touch, true, time + 1.5 * cycle_, 1},
                  {EventKind::release, false, time + 1.5 * cycle_ + 0.1, -0.5}}},
                place_};
    }
    // The same from its second touch on, so many cycles later.
    [[nodiscard]] OrbitPoint from_second(double time, int cycles) const {
        OrbitPoint point = orbit(time);
        auto& events = point.orbit.events;
        std::rotate(events.begin(), events.begin() + 2, events.end());
        events[2].time += 3 * cycle_;
        events[3].time += 3 * cycle_;
        for (Event& event : events) event.time += cycles * cycle_;
        return point;
    }
};

TEST_F(ToldLike, AnOrbitToldFromAnotherCycleIsTheSameOne) {
    const OrbitPoint like = orbit(0.3);
    for (const OrbitPoint& other :
         {orbit(0.31), orbit(0.31 + 2 * cycle_), from_second(0.31, 0), from_second(0.31, -4)}) {
        const auto told = told_like(rig_, other, like.orbit);
        ASSERT_TRUE(told);
        for (std::size_t i = 0; i < like.orbit.events.size(); ++i) {
            EXPECT_EQ(told->orbit.events[i].kind, like.orbit.events[i].kind);
            EXPECT_NEAR(told->orbit.events[i].time, like.orbit.events[i].time + 0.01, 1e-12);
            EXPECT_EQ(told->orbit.events[i].velocity, like.orbit.events[i].velocity);
        }
    }
}

TEST_F(ToldLike, NothingIsToldOfOtherEvents) {
    OrbitPoint other = orbit(0.3);
    other.orbit.events.resize(2);
    EXPECT_FALSE(told_like(rig_, other, orbit(0.3).orbit));
    other = orbit(0.3);
    other.orbit.period = 2;
    EXPECT_FALSE(told_like(rig_, other, orbit(0.3).orbit));
}

}  // namespace
}  // namespace peterka::curves
