// What is sent between ranks arrives as it was.
#include "curves/mpi_packing.hpp"

#include <gtest/gtest.h>

namespace peterka::curves {
namespace {

TEST(MpiPacking, ACurveArrivesAsItWas) {
    double last = 0;  // distinct numbers, so that none can stand for another
    const auto next = [&last] { return last += 0.25; };
    Curve sent;
    sent.kind = CurveKind::grazing;
    sent.impacts = 3;
    sent.period = 2;
    sent.begins = CurveEnd::closed;
    sent.ends = CurveEnd::special;
    sent.edge = LabelEdge::edge;
    for (int n = 0; n < 2; ++n) {
        CurvePoint point;
        point.place = {next(), next()};
        point.multiplier = next();
        point.peak_force = next();
        point.residual = next();
        point.at_phase_0 = {next(), next()};
        point.trace = next();
        point.total_speed = next();
        point.edge = LabelEdge::edge;
        sent.points.push_back(point);
    }
    sent.specials.push_back({SpecialKind::cusp, {next(), next()}});
    Crossing crossing{{next(), next()}, next(), next(), {}};
    crossing.orbit.period = 2;
    crossing.orbit.events = {{EventKind::touch, true, next(), next()},
                             {EventKind::touch, false, next(), next()}};
    sent.crossings.push_back(crossing);

    Numbers numbers;
    pack(sent, numbers);
    NumberReader reader(numbers);
    const Curve got = unpack_curve(reader);
    EXPECT_TRUE(reader.done());
    EXPECT_EQ(got.kind, sent.kind);
    EXPECT_EQ(got.impacts, 3);
    EXPECT_EQ(got.period, 2);
    EXPECT_EQ(got.begins, sent.begins);
    EXPECT_EQ(got.ends, sent.ends);
    EXPECT_EQ(got.edge, sent.edge);
    ASSERT_EQ(got.points.size(), 2U);
    for (std::size_t n = 0; n < 2; ++n) {
        const CurvePoint& a = got.points[n];
        const CurvePoint& b = sent.points[n];
        EXPECT_EQ(a.place.column, b.place.column);
        EXPECT_EQ(a.place.row, b.place.row);
        EXPECT_EQ(a.multiplier, b.multiplier);
        EXPECT_EQ(a.peak_force, b.peak_force);
        EXPECT_EQ(a.residual, b.residual);
        EXPECT_EQ(a.at_phase_0, b.at_phase_0);
        EXPECT_EQ(a.trace, b.trace);
        EXPECT_EQ(a.total_speed, b.total_speed);
        EXPECT_EQ(a.edge, b.edge);
    }
    ASSERT_EQ(got.specials.size(), 1U);
    EXPECT_EQ(got.specials[0].kind, SpecialKind::cusp);
    EXPECT_EQ(got.specials[0].place.row, sent.specials[0].place.row);
    ASSERT_EQ(got.crossings.size(), 1U);
    EXPECT_EQ(got.crossings[0].multiplier, crossing.multiplier);
    EXPECT_EQ(got.crossings[0].peak_force, crossing.peak_force);
    EXPECT_EQ(got.crossings[0].place.column, crossing.place.column);
    EXPECT_EQ(got.crossings[0].orbit.period, 2);
    ASSERT_EQ(got.crossings[0].orbit.events.size(), 2U);
    for (std::size_t n = 0; n < 2; ++n) {
        EXPECT_EQ(got.crossings[0].orbit.events[n].presses, crossing.orbit.events[n].presses);
        EXPECT_EQ(got.crossings[0].orbit.events[n].time, crossing.orbit.events[n].time);
        EXPECT_EQ(got.crossings[0].orbit.events[n].velocity, crossing.orbit.events[n].velocity);
    }
}

TEST(MpiPacking, ABranchArrivesAsItWas) {
    double last = 0;
    const auto next = [&last] { return last += 0.25; };
    UnstableBranch sent;
    sent.gap = next();
    sent.impacts = 3;
    sent.period = 2;
    sent.begins = BranchEnd::fold;
    sent.ends = BranchEnd::grazing;
    for (const std::size_t impacts : {3U, 1U, 0U}) {
        BranchPoint point{.along = next(),
                          .frequency = next(),
                          .gap = next(),
                          .force_ratio = next(),
                          .multiplier = next(),
                          .peak_force = next(),
                          .residual = next(),
                          .at_phase_0 = {{next(), next()}, {next(), next()}},
                          .impact_times = {}};
        for (std::size_t i = 0; i < impacts; ++i) point.impact_times.push_back(next());
        sent.points.push_back(point);
    }

    Numbers numbers;
    pack(sent, numbers);
    NumberReader reader(numbers);
    const UnstableBranch got = unpack_branch(reader);
    EXPECT_TRUE(reader.done());
    EXPECT_EQ(got.gap, sent.gap);
    EXPECT_EQ(got.impacts, 3);
    EXPECT_EQ(got.period, 2);
    EXPECT_EQ(got.begins, sent.begins);
    EXPECT_EQ(got.ends, sent.ends);
    ASSERT_EQ(got.points.size(), 3U);
    for (std::size_t n = 0; n < 3; ++n) {
        const BranchPoint& a = got.points[n];
        const BranchPoint& b = sent.points[n];
        EXPECT_EQ(a.along, b.along);
        EXPECT_EQ(a.frequency, b.frequency);
        EXPECT_EQ(a.gap, b.gap);
        EXPECT_EQ(a.force_ratio, b.force_ratio);
        EXPECT_EQ(a.multiplier, b.multiplier);
        EXPECT_EQ(a.peak_force, b.peak_force);
        EXPECT_EQ(a.residual, b.residual);
        EXPECT_EQ(a.at_phase_0, b.at_phase_0);
        EXPECT_EQ(a.impact_times, b.impact_times);
    }
}

}  // namespace
}  // namespace peterka::curves
