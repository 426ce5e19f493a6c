// A curve traced through a coarse map, its points against the engine, and the map's labels along it.
#include "curves/label_edges.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

#include "coarse_map_example.hpp"
#include "observed.hpp"
#include "told_map.hpp"
#include "trajectory/exact_cycle_map.hpp"

namespace peterka::curves {
namespace {

using testing::coarse_map_example;
using testing::MapExample;

// Where the orbit of one cell ends on the way to the other's place.
Seed seed(std::int64_t from, std::int64_t to) {
    const MapExample& one = coarse_map_example();
    const auto orbit = one.map.orbit(from, one.window());
    EXPECT_TRUE(orbit);
    const auto end = follow(one.rig, *orbit, one.map.place(to), one.window()).seed;
    EXPECT_TRUE(end);
    return *end;
}

Curve traced(const Seed& from, std::vector<double> gaps = {}) {
    const MapExample& one = coarse_map_example();
    return trace_curve(
        one.rig, from,
        {.low = one.map.place(0), .high = one.map.place(one.map.count() - 1), .gaps = std::move(gaps)});
}

Seed doubling_seed() {
    return seed(5, 6);
}  // of 1/1, at the lowest gap
Seed fold_seed() {
    return seed(coarse_map_example().cell(1, 6), coarse_map_example().cell(1, 7));
}  // of 2/2

auto cycle_at(const PlanePoint& place, const State<double>& start) {
    return testing::observed(
        trajectory::ExactCycleMap<double>(testing::paper_rig(testing::beam_170mm, place.column, place.row)),
        start);
}

// By the engine each point's orbit closes, and has the multiplier -1.
TEST(TracedCurve, OfADoublingHasOrbitsThatDouble) {
    const Curve curve = traced(doubling_seed());
    EXPECT_EQ(curve.kind, CurveKind::period_doubling);
    EXPECT_EQ(curve.impacts, 1);
    EXPECT_EQ(curve.period, 1);
    ASSERT_GT(curve.points.size(), 30U);
    for (std::size_t i = 0; i + 1 < curve.points.size(); ++i) {  // the last one's impact has no speed
        const CurvePoint& point = curve.points[i];
        const auto cycle = cycle_at(point.place, point.at_phase_0);
        EXPECT_LT((cycle.end - point.at_phase_0).norm(), 1e-8);
        EXPECT_EQ(cycle.impacts, 1);
        EXPECT_NEAR((cycle.jacobian + Jacobian<double>::Identity()).determinant(), 0, 1e-6);
        EXPECT_NEAR(cycle.jacobian.trace(), point.trace, 1e-6);
        EXPECT_NEAR(point.multiplier, -1, 1e-6);
        EXPECT_NEAR(cycle.peak_force, point.peak_force, 1e-9 + 1e-8 * cycle.peak_force);
        EXPECT_LT(point.residual, 1e-9);
    }
}

TEST(TracedCurve, EndsAtTheBorderAndWhereItGrazes) {
    const Curve curve = traced(doubling_seed());
    EXPECT_EQ(curve.begins, CurveEnd::border);
    EXPECT_EQ(curve.ends, CurveEnd::special);
    EXPECT_NEAR(curve.points.front().place.row, 0.1, 1e-9);
    ASSERT_EQ(curve.specials.size(), 1U);
    EXPECT_EQ(curve.specials[0].kind, SpecialKind::flip_grazing);
    EXPECT_NEAR(curve.specials[0].place.row, curve.points.back().place.row, 1e-6);
    const double steps = static_cast<double>(curve.points.size() - 1);
    for (std::size_t i = 0; i + 1 < curve.points.size(); ++i) {
        const PlanePoint& a = curve.points[i].place;
        const PlanePoint& b = curve.points[i + 1].place;
        EXPECT_LT(std::hypot((b.column - a.column) / 2, (b.row - a.row) / 1.5), 4 / steps);
    }
}

TEST(TracedCurve, OfAFoldHasTheMultiplierOne) {
    const Curve curve = traced(fold_seed());
    EXPECT_EQ(curve.kind, CurveKind::fold);
    EXPECT_EQ(curve.impacts, 2);
    EXPECT_EQ(curve.period, 2);
    for (const CurvePoint& point : curve.points) {
        const auto once = cycle_at(point.place, point.at_phase_0);
        const auto twice = cycle_at(point.place, once.end);
        EXPECT_LT((twice.end - point.at_phase_0).norm(), 1e-7);
        const Jacobian<double> both = twice.jacobian * once.jacobian;
        EXPECT_NEAR((both - Jacobian<double>::Identity()).determinant(), 0, 1e-5);
        EXPECT_NEAR(point.multiplier, 1, 1e-5);
        EXPECT_NEAR(std::max(once.peak_force, twice.peak_force), point.peak_force, 1e-7 * point.peak_force);
    }
}

TEST(TracedCurve, HasACuspWhereverItTurnsBack) {
    const Curve curve = traced(fold_seed());
    const auto chord = [&](std::size_t i) {
        const PlanePoint& a = curve.points[i].place;
        const PlanePoint& b = curve.points[i + 1].place;
        return Eigen::Vector2d((b.column - a.column) / 2, (b.row - a.row) / 1.5);
    };
    std::ptrdiff_t turns = 0;
    for (std::size_t i = 0; i + 2 < curve.points.size(); ++i) turns += chord(i).dot(chord(i + 1)) < 0 ? 1 : 0;
    EXPECT_EQ(std::ranges::count(curve.specials, SpecialKind::cusp, &Special::kind), turns);
}

TEST(TracedCurve, HasItsCrossingsOfGaps) {
    const Curve curve = traced(doubling_seed(), {0.05, 0.5, 1.0, 1.5});
    ASSERT_EQ(curve.crossings.size(), 2U);
    for (const Crossing& crossing : curve.crossings) {
        EXPECT_TRUE(crossing.place.row == 0.5 || crossing.place.row == 1.0);
        EXPECT_NEAR(crossing.multiplier, -1, 1e-6);
        const auto beside = std::ranges::min(curve.points, {}, [&](const CurvePoint& point) {
            return std::abs(point.place.row - crossing.place.row);
        });
        EXPECT_NEAR(beside.place.column, crossing.place.column, 0.02);
        EXPECT_NEAR(beside.peak_force, crossing.peak_force, 0.05 * crossing.peak_force);
    }
    EXPECT_NE(curve.crossings[0].place.row, curve.crossings[1].place.row);
}

std::int64_t points_with(const Curve& curve, LabelEdge edge) {
    return std::ranges::count(curve.points, edge, &CurvePoint::edge);
}

// 1/1 beside 2/2 all along the doubling; beside the fold, labels of 2/2 end before it does.
TEST(LabelEdges, AreSeenWhereTheMapChanges) {
    Curve doubling = traced(doubling_seed());
    tell_edges(coarse_map_example().rig, coarse_map_example().map, doubling);
    EXPECT_EQ(doubling.edge, LabelEdge::edge);
    EXPECT_EQ(points_with(doubling, LabelEdge::edge), std::ssize(doubling.points));
    Curve fold = traced(fold_seed());
    tell_edges(coarse_map_example().rig, coarse_map_example().map, fold);
    EXPECT_EQ(fold.edge, LabelEdge::edge);
    EXPECT_GT(points_with(fold, LabelEdge::edge), 60);
    EXPECT_EQ(points_with(fold, LabelEdge::edge) + points_with(fold, LabelEdge::same_label),
              std::ssize(fold.points));
    for (const CurvePoint& point : fold.points) {
        EXPECT_TRUE(point.edge == LabelEdge::edge || point.place.row > 1.2);
    }
}

// A map all of 1/2 has neither label.
TEST(LabelEdges, HaveAReasonWhereTheMapHasNone) {
    const MapExample other({3.3, 3.5, 3}, {0.1, 0.4, 3});
    ASSERT_EQ(other.map.site(4).period, 2);
    ASSERT_EQ(other.map.site(4).impacts, 1);
    for (const Seed& from : {doubling_seed(), fold_seed()}) {
        Curve curve = traced(from);
        tell_edges(other.rig, other.map, curve);
        EXPECT_EQ(curve.edge, LabelEdge::other_start) << static_cast<int>(curve.kind);
        EXPECT_EQ(points_with(curve, LabelEdge::edge) + points_with(curve, LabelEdge::same_label), 0);
        EXPECT_GT(points_with(curve, LabelEdge::other_start), 20);
    }
}

TEST(LabelEdges, OfACurveWithoutPointsAreNotTold) {
    Curve none;
    tell_edges(coarse_map_example().rig, coarse_map_example().map, none);
    EXPECT_EQ(none.edge, LabelEdge::unknown);
}

// A map of 1/1 up to its fourth row and 1/2 from there on, and a point of a curve of 1/1 at a distance below,
// in cells, from where the label changes.
LabelEdge told_at(double cells_below) {
    const MapExample& one = coarse_map_example();
    std::vector<Site> sites;
    for (std::int64_t cell = 0; cell < one.map.count(); ++cell) {
        const std::int64_t period = cell < one.cell(4, 0) ? 1 : 2;
        sites.push_back({.regime = regime::Regime::periodic, .impacts = 1, .period = period});
    }
    const CoarseMap map = testing::told_map(one.scene, one.rig, sites);
    Curve curve;
    curve.kind = CurveKind::fold;
    CurvePoint point;
    point.place = {2.5, 0.1 + 0.3 * (3.5 - cells_below)};
    point.orbit = {1, {{EventKind::touch, true, 0, 1}}};
    curve.points = {point};
    tell_edges(one.rig, map, curve);
    return curve.points.front().edge;
}

TEST(LabelEdges, AreSeenWithinACell) {
    EXPECT_EQ(told_at(0.6), LabelEdge::edge);
    EXPECT_EQ(told_at(0.9), LabelEdge::edge);
    EXPECT_EQ(told_at(1.1), LabelEdge::same_label);
    EXPECT_EQ(told_at(1.4), LabelEdge::same_label);
    EXPECT_EQ(told_at(-1.1), LabelEdge::same_label);
}

}  // namespace
}  // namespace peterka::curves
