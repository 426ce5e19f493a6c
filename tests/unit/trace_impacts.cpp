// Impacts of a trace, from hand-made events: bounces on a rigid stop that end in a rest are one.
#include "trace/impacts.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include "rig.hpp"
#include "trace/trace.hpp"

namespace peterka::trace {
namespace {

// What a recorder tells of a rigid stop, at times since the trace began.
class Told {
  public:
    explicit Told(double length) : impacts_(length) {}

    [[nodiscard]] const std::vector<Impact>& all() const { return impacts_.all(); }
    void bounce(double time, double work) {
        go(time);
        impacts_.touch(3);
        impacts_.leave({regime::unknown, 4, 0, work});
    }
    void rest(double time, std::int64_t impacts) {
        go(time);
        impacts_.rest(impacts);
    }
    void lift_off(double time, double work) {
        go(time);
        impacts_.leave({2, 1, 1, work});
    }

  private:
    void go(double time) {
        impacts_.stretch(Phase::flight, 0, time, [](double) { return State<double>::Zero().eval(); });
    }
    Impacts impacts_;
};

TEST(Impacts, StaySingleIfTheirRestBeginsWithTheEndOfTheTraceOrLater) {
    for (const double rest : {4.0, 5.0}) {
        Told told(4);
        told.bounce(1, 16);
        told.bounce(2, 8);
        told.rest(rest, 2);
        told.lift_off(6, 1);
        ASSERT_EQ(told.all().size(), 2U);
        EXPECT_EQ(told.all()[0].record.work, 16);
        EXPECT_EQ(told.all()[1].record.work, 8);
        EXPECT_EQ(told.all()[1].end, 2);
    }
}

// Those of a motion that was followed before this trace began.
TEST(Impacts, BeforeTheTraceAreNotLookedFor) {
    Told told(20);
    told.bounce(1, 16);
    told.rest(2, 3);
    told.lift_off(6, 1);
    ASSERT_EQ(told.all().size(), 1U);
    EXPECT_EQ(told.all()[0].end, 6);
    EXPECT_EQ(told.all()[0].record.work, 16 + 1);
}

// With r = 0 the hammer sticks at its first impact, until eta^2 sin(theta) has fallen to the gap. Of a force
// that is not known there is no spectrum.
TEST(Trace, OfARestOnARigidStopHasNoSpectrumOfIt) {
    constexpr double eta = 0.978;
    constexpr double gap = -0.5;
    job::Job job = testing::job_170mm(0);
    job.kind = job::Kind::trace;
    job.operating_point = {eta, gap};
    job.contact = job::Restitution{0};
    job.start = {-1, 0};
    job.trace.cycles = 3;
    job.trace.spectrum_to_hz = 500;
    const Trace trace = make_trace(scene::Scene(job));
    ASSERT_EQ(trace.impacts.size(), 3U);
    for (std::size_t n = 0; n < trace.impacts.size(); ++n) {
        const Impact& impact = trace.impacts[n];
        const double lift_off =
            (std::numbers::pi * static_cast<double>(2 * n + 1) - std::asin(gap / (eta * eta))) / eta;
        EXPECT_NEAR(impact.end, lift_off, 1e-12);
        EXPECT_GT(impact.end, impact.time + 0.1);
        EXPECT_TRUE(std::isnan(impact.record.peak_force));
    }
    ASSERT_TRUE(trace.hardest);
    EXPECT_FALSE(trace.hardest->spectrum);
}

}  // namespace
}  // namespace peterka::trace
