// Distances along rows and columns, against closed forms, searches next to them, and each other.
#include "curves/edge_distance.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "coarse_map_example.hpp"
#include "told_map.hpp"

namespace peterka::curves {
namespace {

using testing::coarse_map_example;

std::vector<EdgeDistance> row(std::int64_t number, std::int64_t most_period = 2) {
    return edge_distances(coarse_map_example().map, coarse_map_example().rig, most_period, {true, number});
}
std::vector<EdgeDistance> column(std::int64_t number) {
    return edge_distances(coarse_map_example().map, coarse_map_example().rig, 2, {false, number});
}
double frequency(std::size_t number) {
    return 1.5 + 0.2 * static_cast<double>(number);
}
scene::Oscillator<double> rig_at(double frequency_ratio, double gap_ratio) {
    return testing::paper_rig(testing::beam_170mm, frequency_ratio, gap_ratio);
}

TEST(EdgeDistance, NumbersCellsAlongARowAndAColumn) {
    EXPECT_EQ(cell_of(coarse_map_example().map, {true, 3}, 4), 37);
    EXPECT_EQ(cell_of(coarse_map_example().map, {false, 3}, 4), 47);
}

// The motion without impacts ends where its swing is the gap.
TEST(EdgeDistance, OfAFreeMotionIsToTheSwing) {
    const auto along = row(5);
    for (const std::size_t i : {2U, 3U, 6U, 10U}) {
        EXPECT_EQ(along[i].kind, EdgeKind::grazing);
        const double end = frequency(i) + along[i].change;
        EXPECT_NEAR(testing::free_amplitude(rig_at(end, 1.6)), 1.6, 1e-9);
        const auto across = column(static_cast<std::int64_t>(i))[5];
        EXPECT_EQ(across.kind, EdgeKind::grazing);
        EXPECT_NEAR(testing::free_amplitude(rig_at(frequency(i), 1)), 1.6 + across.change, 1e-9);
    }
}

// On either side of its end, 0.01 away, searches find another motion.
TEST(EdgeDistance, OfAnOrbitIsToWhereItsPeriodDoubles) {
    const auto along = row(0);
    const double end = frequency(0) + along[0].change;
    for (std::size_t i = 0; i < 7; ++i) {  // the doubled orbit begins where the other ends
        EXPECT_EQ(along[i].kind, EdgeKind::period_doubling) << i;
        EXPECT_NEAR(frequency(i) + along[i].change, end, 1e-9) << i;
    }
    EXPECT_EQ(testing::solve(rig_at(end - 0.01, 0.1)).period, 1);
    EXPECT_EQ(testing::solve(rig_at(end + 0.01, 0.1)).period, 2);
}

TEST(EdgeDistance, OfAnOrbitIsToItsGrazing) {
    const auto along = row(0)[8];  // 3/2
    EXPECT_EQ(along.kind, EdgeKind::grazing);
    const auto across = column(8)[0];
    EXPECT_EQ(across.kind, EdgeKind::grazing);
    EXPECT_EQ(testing::solve(rig_at(3.1 + along.change - 0.005, 0.1)).impacts, 3);
    EXPECT_NE(testing::solve(rig_at(3.1 + along.change + 0.005, 0.1)).impacts, 3);
    EXPECT_EQ(testing::solve(rig_at(3.1, 0.1 + across.change - 0.005)).impacts, 3);
    EXPECT_NE(testing::solve(rig_at(3.1, 0.1 + across.change + 0.005)).impacts, 3);
}

// Its fold lies beyond the last row that the doubled orbits of this column have, and below 1.7.
TEST(EdgeDistance, OfAColumnIsToItsFold) {
    const auto along = column(2);
    for (std::size_t i = 0; i < 5; ++i) {
        EXPECT_EQ(along[i].kind, EdgeKind::fold) << i;
        EXPECT_NEAR(0.1 + 0.3 * static_cast<double>(i) + along[i].change, 0.1 + along[0].change, 1e-9) << i;
    }
    EXPECT_EQ(testing::solve(rig_at(1.9, 0.1 + along[0].change - 0.02)).impacts, 1);
    EXPECT_EQ(testing::solve(rig_at(1.9, 0.1 + along[0].change + 0.005)).regime, regime::Regime::no_impact);
}

// A map whose first cell is here, on a stop that takes all speed.
testing::MapExample on_a_plastic_stop(double frequency, double gap) {
    job::Job job = testing::job_170mm(0);
    job.kind = job::Kind::curves;
    job.contact = job::Restitution{0};
    job.hammer.damping_ns_per_m =
        2 * 0.04741211231793658 * std::sqrt(job.hammer.stiffness() * job.hammer.mass_kg);
    job.columns = {frequency, frequency + 0.01, 2};
    job.rows = {gap, gap + 0.02, 2};
    job.start = {-0.1, 0};
    return testing::MapExample(job);
}

// The edge of its gap.
EdgeDistance edge_of(const testing::MapExample& one, std::int64_t impacts, std::int64_t period) {
    EXPECT_EQ(one.map.site(0).impacts, impacts);
    EXPECT_EQ(one.map.site(0).period, period);
    return edge_distances(one.map, one.rig, 4, {false, 0})[0];
}

// The motion of that cell's start, at a part of the way to the edge that is told of its gap.
regime::CellResult solved_at(const testing::MapExample& one, const EdgeDistance& edge, double part) {
    scene::Oscillator<double> oscillator = one.scene.cell(0, 0).oscillator;
    oscillator.gap += part * edge.change;
    return testing::solve(oscillator, -0.1);
}

// A multiplier falls to minus infinity where an impact becomes a grazing, and beyond, where the equations
// describe no motion, comes back from infinity: the period doubles at 0.718 of the way there.
TEST(EdgeDistance, OfAnOrbitIsToWhereItsPeriodDoublesBeforeItGrazes) {
    const testing::MapExample one = on_a_plastic_stop(0.7488097959240669, 1.1786750273656639);
    const EdgeDistance edge = edge_of(one, 3, 4);
    EXPECT_EQ(edge.kind, EdgeKind::period_doubling);
    EXPECT_NEAR(edge.change, 0.0016128129709, 1e-9);
    EXPECT_EQ(solved_at(one, edge, 0.9).period, 4);
    EXPECT_EQ(solved_at(one, edge, 0.9).impacts, 3);
    EXPECT_GT(solved_at(one, edge, 0.9).multiplier, 0.8);
    EXPECT_NE(solved_at(one, edge, 1.05).period, 4);
}

// Beyond the fold the branch turns back, to a grazing that is nearer.
TEST(EdgeDistance, OfAnOrbitIsToItsFoldBeforeAGrazing) {
    const testing::MapExample one = on_a_plastic_stop(0.7896775821831176, 1.3740133087077377);
    const EdgeDistance edge = edge_of(one, 2, 2);
    EXPECT_EQ(edge.kind, EdgeKind::fold);
    EXPECT_NEAR(edge.change, 0.0023081658894, 1e-9);
    EXPECT_EQ(solved_at(one, edge, 0.99).impacts, 2);
    EXPECT_EQ(solved_at(one, edge, 1.01).impacts, 1);
}

TEST(EdgeDistance, IsNoneWhereNothingEndsInTheWindow) {
    for (const EdgeDistance& each : {column(0)[0], column(0)[5], column(10)[2]}) {
        EXPECT_EQ(each.kind, EdgeKind::none);
        EXPECT_TRUE(std::isnan(each.change));
    }
}

TEST(EdgeDistance, IsOfOrbitsThatCurvesCover) {
    EXPECT_EQ(coarse_map_example().map.site(7).period, 4);
    EXPECT_EQ(row(0)[7].kind, EdgeKind::no_orbit);
    EXPECT_TRUE(std::isnan(row(0)[7].change));
    EXPECT_NE(row(0, 4)[7].kind, EdgeKind::no_orbit);
    EXPECT_EQ(row(1, 4)[8].kind, EdgeKind::no_orbit);  // chaos
}

// The orbit passes through such a cell, but it is not told to be the cell's own motion.
TEST(EdgeDistance, IsNotThatOfAnOrbitWhichTheCellIsNotToldToHave) {
    const testing::MapExample& one = coarse_map_example();
    std::vector<Site> sites;
    for (std::int64_t cell = 0; cell < one.map.count(); ++cell) sites.push_back(one.map.site(cell));
    sites[3].regime = regime::Regime::chaotic;
    sites[4].period = 2;
    const CoarseMap map = testing::told_map(one.scene, one.rig, sites);
    const auto along = edge_distances(map, one.rig, 1, {true, 0});
    const auto as_solved = row(0, 1);
    EXPECT_EQ(along[3].kind, EdgeKind::no_orbit);
    EXPECT_EQ(along[4].kind, EdgeKind::no_orbit);
    for (const std::size_t i : {0U, 1U, 2U, 5U}) {
        EXPECT_EQ(along[i].kind, EdgeKind::period_doubling) << i;
        EXPECT_EQ(along[i].change, as_solved[i].change) << i;
    }
}

}  // namespace
}  // namespace peterka::curves
