// The stable motions beside points of curves.
#include "curves/beside.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "curves/follow.hpp"
#include "curves/free_motion.hpp"
#include "curves/stroboscopic.hpp"
#include "rig.hpp"
#include "trajectory/exact_cycle_map.hpp"

namespace peterka::curves {
namespace {

const PlanePoint sizes{4, 5};
const PlanePoint along_frequency{1, 0};
const Rig rig_of_paper(testing::paper_rig(testing::beam_170mm, 1, 0));

Seed end_of_orbit(const PlanePoint& from, const PlanePoint& to, const State<double>& start = {0, 0}) {
    const auto oscillator = testing::paper_rig(testing::beam_170mm, from.column, from.row);
    const trajectory::ExactCycleMap<double> map(oscillator);
    State<double> x = testing::start_at(oscillator, start[0], start[1]);
    for (int cycle = 0; cycle < 2000; ++cycle) x = map(x).end;
    const auto orbit = stable_orbit_near(rig_of_paper, from, x, 1, sizes);
    EXPECT_TRUE(orbit);
    const FollowedOrbit followed = follow(rig_of_paper, *orbit, to, sizes);
    EXPECT_TRUE(followed.seed);
    return *followed.seed;
}

// By the engine, from the orbit's own state: it returns after its period and not earlier.
void expect_returns(const OrbitPoint& point, std::int64_t period) {
    const auto oscillator = testing::paper_rig(testing::beam_170mm, point.place.column, point.place.row);
    const trajectory::ExactCycleMap<double> map(oscillator);
    const State<double> start = stroboscopic_states(rig_of_paper, point).front().state;
    State<double> x = start;
    for (std::int64_t cycle = 1; cycle <= period; ++cycle) {
        x = map(x).end;
        const double distance = (x - start).lpNorm<Eigen::Infinity>();
        if (cycle == period)
            EXPECT_LT(distance, 1e-9);
        else
            EXPECT_GT(distance, 1e-6);
    }
}

TEST(CurvesBeside, ADoublingHasOneStableOrbitOnEachSide) {
    const Seed at = end_of_orbit({2, 0}, {3, 0});
    const Beside beside = motions_beside(rig_of_paper, sizes, at, along_frequency);
    ASSERT_EQ(beside.stable.size(), 1U);
    EXPECT_LT(beside.stable.front().place.column, at.point.place.column);
    const auto doubled = stable_doubled_beside(rig_of_paper, sizes, at.point, along_frequency);
    ASSERT_EQ(doubled.size(), 1U);
    EXPECT_GT(doubled.front().place.column, at.point.place.column);
    EXPECT_EQ(doubled.front().orbit.impacts(), 2);
    expect_returns(doubled.front(), 2);
}

// The free motion ends, and the orbit with the new impact is unstable.
TEST(CurvesBeside, WhereTheFreeMotionEndsNoStableImpactNeedBegin) {
    const auto end =
        end_of_free_motion(rig_of_paper, {2.5, 1.1235955056179776}, {4.0, 1.1235955056179776}, sizes);
    ASSERT_TRUE(end);
    const Beside beside = motions_beside(rig_of_paper, sizes, *end, along_frequency);
    EXPECT_EQ(beside.stable.size(), 1U);
    for (const OrbitPoint& stable : beside.stable) EXPECT_TRUE(stable.orbit.events.empty());
}

TEST(CurvesBeside, AFoldHasOneStableOrbitOnOneSide) {
    const Seed at = end_of_orbit({1.6, 1.5}, {2.2, 1.5}, {-1, 2});
    const Beside beside = motions_beside(rig_of_paper, sizes, at, along_frequency);
    ASSERT_EQ(beside.stable.size(), 1U);
    EXPECT_LT(beside.stable.front().place.column, at.point.place.column);
}

}  // namespace
}  // namespace peterka::curves
