// A hammer that sticks to a rigid stop, at once or after chatter: against formulas and balances.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <tuple>
#include <utility>

#include "rigid_rig.hpp"
#include "trajectory/exact_cycle_map.hpp"
#include "trajectory/free_flight.hpp"
#include "trajectory/split_cycle_map.hpp"

namespace peterka::trajectory {
namespace {

using testing::rigid;
using Outcome = Cycle<double>::Outcome;

// r = 0 and gap 0: the hammer sticks from its first impact
// while 4 sin(theta) > 0, and is released at theta = pi.
TEST(RigidCycleMap, SticksUntilThePhaseOfRelease) {
    for (const double gap : {0.0, 0.5, 1.0}) {
        const auto oscillator = rigid(0, 2, gap);
        const RigidStop<double> stop(oscillator);
        const double release = std::numbers::pi - std::asin(gap / 4);
        // from rest at the release to the end of the cycle
        const motion::LinearMotion<double> flight(motion::flight_equation(oscillator));
        const Leg<double> fall(flight, State<double>::Zero(), release);
        const State<double> expected = fall.at((2 * std::numbers::pi - release) / 2).state;
        ASSERT_LT(expected[0], 0);

        const State<double> x(-1, 5);
        Recorder<double> recorder(Detail::contacts);
        const auto cycle = RigidExactMap<double>(oscillator)(x, &recorder);
        ASSERT_EQ(cycle.impacts, 1);
        EXPECT_LT((cycle.end - expected).norm(), 1e-14);
        EXPECT_EQ(cycle.jacobian.norm(), 0);
        EXPECT_TRUE(cycle.touched);
        EXPECT_TRUE(cycle.separated);

        const Leg<double> rise(flight, x, 0);
        const Probe<double> touch({.position = 1}, flight);
        const auto hit = first_crossing(rise, touch, rise.start(), 1.0);
        const double duration = release / 2 - hit.moment.time;
        const auto& totals = recorder.totals();
        EXPECT_NEAR(totals.contact_time, duration, 1e-14);
        const double pressed = 2 * (std::cos(2 * hit.moment.time) - std::cos(release)) - gap * duration;
        EXPECT_NEAR(totals.impulse, hit.moment.state[1] + pressed, 1e-12);
        EXPECT_NEAR(totals.largest_force, 4 - gap, 1e-14);
        EXPECT_FALSE(totals.chatter) << "one impact is no chatter";
        EXPECT_EQ(totals.impacts, 1);
    }
}

// Many small impacts end in sticking: one impact, flagged, of the duration given by the individual impacts.
TEST(RigidCycleMap, ACompletedChatterIsOneImpact) {
    for (const double r : {0.2, 0.6, 0.8}) {
        const auto oscillator = rigid(r, 1.3, 0.2);
        const RigidExactMap<double> map(oscillator);
        const State<double> x(-0.01, 0.05);
        Recorder<double> recorder(Detail::energy);
        const auto cycle = map(x, &recorder);
        Recorder<long double> finer(Detail::energy);
        const auto expected =
            RigidExactMap<long double>(rigid<long double>(r, 1.3, 0.2))(x.cast<long double>(), &finer);
        EXPECT_GT(expected.impacts, cycle.impacts);  // followed longer
        const auto& totals = recorder.totals();
        EXPECT_TRUE(totals.chatter);
        EXPECT_EQ(totals.impacts, 1) << r;
        EXPECT_EQ(cycle.pattern, expected.pattern);
        EXPECT_EQ(cycle.jacobian.norm(), 0);
        EXPECT_NEAR(totals.contact_time, static_cast<double>(finer.totals().contact_time), 1e-13);
        EXPECT_NEAR(totals.impulse, static_cast<double>(finer.totals().impulse), 1e-13);
        EXPECT_NEAR(totals.contact_work, static_cast<double>(finer.totals().contact_work), 1e-13);
    }
}

// Two chatter sequences of which only the second ends in sticking: the first counts impact by impact.
TEST(RigidCycleMap, ChatterThatIsNotCompletedCountsEachImpact) {
    const auto oscillator = rigid(0.9, 3.0, 0.0);
    Recorder<double> recorder;
    const auto cycle = RigidExactMap<double>(oscillator)({-0.1, 4}, &recorder);
    ASSERT_GT(cycle.impacts, 0);
    EXPECT_FALSE(recorder.totals().chatter);
    EXPECT_EQ(recorder.totals().impacts, cycle.impacts);
    EXPECT_FALSE(recorder.is_open());
}

// At a negative gap the hammer is preloaded at phase 0, and chatter may continue across it. On the periodic
// orbit the impulse over a cycle is minus the integral of u, and the energy balance closes.
TEST(RigidCycleMap, ChatterMayCrossTheEndOfACycle) {
    int crossed = 0;
    for (const auto& [eta, gap] :
         {std::pair{0.4, -0.1}, std::pair{0.6, -0.3}, std::pair{0.8, -0.55}, std::pair{1.0, -0.9}}) {
        for (const double r : {0.3, 0.6, 0.8}) {
            const auto oscillator = rigid(r, eta, gap);
            const RigidLegs<double> legs(oscillator);
            const RigidExactMap<double> map(oscillator);
            State<double> x(-1, 0);
            for (int n = 0; n < 300; ++n) x = map(x).end;
            Recorder<double> recorder(Detail::energy);
            const auto first = map(x, &recorder);
            ASSERT_LT((first.end - x).norm(), 1e-12);
            ASSERT_TRUE(recorder.is_open() && first.separated);
            crossed += x[0] < 0;  // not sticking at phase 0
            recorder.reset_totals();
            std::ignore = map(x, &recorder);
            const auto& totals = recorder.totals();
            EXPECT_EQ(totals.impacts, 1) << gap << " " << r;
            EXPECT_TRUE(totals.chatter);
            EXPECT_NEAR(totals.drive_work, totals.damper_work + totals.contact_work, 1e-12);
            // trapezoidal rule; intermediate states are those of a run that stops there
            constexpr int pieces = 4000;
            double sum = 0;
            Journey<double> journey = legs.depart(x);
            double last = x[0];
            for (int n = 1; n <= pieces; ++n) {
                ASSERT_TRUE(legs.run(journey, oscillator.period() * n / pieces, nullptr));
                sum += (last + journey.cycle.end[0]) / 2 + gap;
                last = journey.cycle.end[0];
            }
            EXPECT_NEAR(totals.impulse, -sum * oscillator.period() / pieces, 1e-5) << gap << " " << r;
        }
    }
    EXPECT_GE(crossed, 6);
}

// Kicks vanish at the stop, so sticking follows the linear equation, with the cubic spring's load there.
TEST(RigidSplitMap, SticksAsTheCubicSpringLetsIt) {
    for (const auto form : {job::CubicForm::relative, job::CubicForm::absolute}) {
        auto oscillator = rigid(0.05, 2, 0.3);
        oscillator.cubic = 0.05;
        oscillator.cubic_form = form;
        const State<double> x(-1, 5);
        Recorder<double> recorder(Detail::contacts);
        const auto cycle = ::peterka::trajectory::RigidSplitMap<double>(oscillator, 400)(x, &recorder);
        ASSERT_EQ(cycle.outcome, Outcome::done);
        EXPECT_EQ(cycle.jacobian.norm(), 0);
        EXPECT_EQ(recorder.totals().impacts, 1);
        // second order in the step
        Recorder<double> finer(Detail::contacts);
        const auto fine = ::peterka::trajectory::RigidSplitMap<double>(oscillator, 1600)(x, &finer);
        Recorder<double> coarser(Detail::contacts);
        const auto coarse = ::peterka::trajectory::RigidSplitMap<double>(oscillator, 100)(x, &coarser);
        EXPECT_LT((cycle.end - fine.end).norm(), 3e-5);
        EXPECT_LT((cycle.end - fine.end).norm(), (coarse.end - fine.end).norm() / 8);
        EXPECT_NEAR(recorder.totals().contact_time, finer.totals().contact_time, 1e-5);
    }
    // without a cubic the steps change nothing
    const auto oscillator = rigid(0.6, 1.3, 0.2);
    const State<double> x(-0.01, 0.3);
    EXPECT_LT((::peterka::trajectory::RigidSplitMap<double>(oscillator, 20)(x).end -
               RigidExactMap<double>(oscillator)(x).end)
                  .norm(),
              1e-14);
}

}  // namespace
}  // namespace peterka::trajectory
