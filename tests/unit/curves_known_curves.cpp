#include "curves/known_curves.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace peterka::curves {
namespace {

CurvePoint at(double column, double row, double trace, double speed) {
    CurvePoint point;
    point.place = {column, row};
    point.trace = trace;
    point.total_speed = speed;
    return point;
}

// Two legs of a right angle, from (1, 1) to (3, 1) to (3, 5); one step twice.
Curve corner() {
    Curve curve;
    curve.kind = CurveKind::fold;
    curve.period = 2;
    curve.points = {at(1, 1, 0, 10), at(3, 1, 2, 20), at(3, 1, 2, 20), at(3, 5, 6, 40)};
    return curve;
}

TEST(KnownCurves, DistanceIsThatOfTheNearestChord) {
    const Nearest below = nearest_on(corner(), {1.5, 0.5}, {1, 1});
    EXPECT_DOUBLE_EQ(below.distance, 0.5);
    EXPECT_DOUBLE_EQ(below.trace, 0.5);
    EXPECT_DOUBLE_EQ(below.total_speed, 12.5);
    const Nearest beside = nearest_on(corner(), {3.25, 2}, {1, 1});
    EXPECT_DOUBLE_EQ(beside.distance, 0.25);
    EXPECT_DOUBLE_EQ(beside.trace, 3);
    EXPECT_DOUBLE_EQ(beside.total_speed, 25);
    EXPECT_DOUBLE_EQ(nearest_on(corner(), {0, 1}, {1, 1}).distance, 1);             // before the first point
    EXPECT_DOUBLE_EQ(nearest_on(corner(), {3, 7}, {1, 4}).distance, 0.5);           // after the last
    EXPECT_DOUBLE_EQ(nearest_on(corner(), {4, 0}, {1, 1}).distance, std::sqrt(2));  // at the corner
}

TEST(KnownCurves, APointLiesOnACurveOfItsKindPeriodAndOrbit) {
    const PlanePoint window{4, 4};
    EXPECT_TRUE(lies_on(corner(), CurveKind::fold, 2, at(2, 1.001, 1, 15), window));
    EXPECT_FALSE(lies_on(corner(), CurveKind::fold, 2, at(2, 1.02, 1, 15), window));
    EXPECT_FALSE(lies_on(corner(), CurveKind::grazing, 2, at(2, 1, 1, 15), window));
    EXPECT_FALSE(lies_on(corner(), CurveKind::fold, 1, at(2, 1, 1, 15), window));
    EXPECT_FALSE(lies_on(corner(), CurveKind::fold, 2, at(2, 1, 1.2, 15), window));
    EXPECT_FALSE(lies_on(corner(), CurveKind::fold, 2, at(2, 1, 1, 16), window));
    CurvePoint with_another = at(2, 1, 1, 15);
    with_another.impacts = 1;
    EXPECT_FALSE(lies_on(corner(), CurveKind::fold, 2, with_another, window));
    Curve gaining = corner();
    gaining.points[1].impacts = 1;  // from there on
    EXPECT_TRUE(lies_on(gaining, CurveKind::fold, 2, with_another, window));
}

// Along (1, 1) to (3, 1); of such a curve, only some points are recognized if their traces are off.
Curve straight(const std::vector<std::size_t>& off) {
    Curve curve;
    curve.kind = CurveKind::fold;
    curve.period = 2;
    for (std::size_t i = 0; i <= 12; ++i) {
        const double share = static_cast<double>(i) / 12;
        const double trace = 2 * share + (std::ranges::count(off, i) > 0 ? 1 : 0);
        curve.points.push_back(at(1 + 2 * share, 1, trace, 10 + 10 * share));
    }
    return curve;
}

TEST(KnownCurves, ACurveIsKnownByMostOfItsPoints) {
    const PlanePoint window{4, 4};
    EXPECT_TRUE(is_same(corner(), straight({}), window));
    EXPECT_TRUE(is_same(corner(), straight({5, 6, 7}), window));  // around its middle
    Curve elsewhere = straight({});
    for (CurvePoint& point : elsewhere.points) point.place.row += 0.5;
    EXPECT_FALSE(is_same(corner(), elsewhere, window));
}

TEST(KnownCurves, ALongerOneCoversAPartOfIt) {
    const PlanePoint window{4, 4};
    EXPECT_EQ(points_on(straight({}), corner(), window), 5);
    EXPECT_LT(points_on(corner(), straight({}), window), 5);
    EXPECT_TRUE(is_same(straight({}), corner(), window));
}

}  // namespace
}  // namespace peterka::curves
