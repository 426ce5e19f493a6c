// What happens in one step, by a stepper that moves in closed form or by small steps of Runge and Kutta.
#include "integrators/events.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "rig.hpp"

namespace peterka::integrators {
namespace {

using testing::beam_170mm;
using testing::paper_rig;

// From `begin` on, by so many steps of the classical method of order 4, flow and all.
LegPoint moved(const SundialsLeg& leg, LegPoint point, double time, int steps) {
    const double h = (time - point.time) / steps;
    const auto slope = [&](const LegPoint& p) {
        const auto a = leg.acceleration_at(p.state, p.time);
        Jacobian<double> rate;
        rate << 0, 1, a.by_position, a.by_velocity;
        return LegPoint{1, {p.state[1], a.value}, rate * p.flow};
    };
    const auto after = [](const LegPoint& p, const LegPoint& rate, double by) {
        return LegPoint{p.time + by, p.state + by * rate.state, p.flow + by * rate.flow};
    };
    for (int n = 0; n < steps; ++n) {
        const LegPoint a = slope(point);
        const LegPoint b = slope(after(point, a, h / 2));
        const LegPoint c = slope(after(point, b, h / 2));
        const LegPoint d = slope(after(point, c, h));
        point = {point.time + h, point.state + h / 6 * (a.state + 2 * b.state + 2 * c.state + d.state),
                 point.flow + h / 6 * (a.flow + 2 * b.flow + 2 * c.flow + d.flow)};
    }
    return point;
}

struct SmallSteps {
    const SundialsLeg* leg = nullptr;
    LegPoint from{};
    LegPoint to{};
    int looks = 0;
    bool sound = true;

    [[nodiscard]] const LegPoint& before() const { return from; }
    [[nodiscard]] const LegPoint& now() const { return to; }
    bool look(double time, LegPoint& point) {
        ++looks;
        point = moved(*leg, from, time, 64);
        return sound;
    }
};

// One step from a state in a phase.
struct Trial {
    SundialsLeg leg;
    SmallSteps stepper;
    StepEvents<SmallSteps> events{leg, stepper};

    Trial(const Oscillator<double>& oscillator, Phase phase, const State<double>& start, double length,
          double begin = 0) {
        leg = {.oscillator = oscillator, .local_tolerance = 1e-9, .phase = phase, .start_angle = 0.4};
        stepper.leg = &leg;
        stepper.from.time = begin;
        stepper.from.state = start;
        stepper.to = moved(leg, stepper.from, begin + length, 400);
    }
    Trial(const Trial&) = delete;
    Trial& operator=(const Trial&) = delete;
    Trial(Trial&&) = delete;
    Trial& operator=(Trial&&) = delete;
    ~Trial() = default;

    [[nodiscard]] State<double> at(double share) const {
        const double begin = stepper.from.time;
        return moved(leg, stepper.from, begin + share * (stepper.to.time - begin), 60).state;
    }
    // The first share of the step, in steps of 1/500, at which a function of the state is above 0.
    template <class Function>
    [[nodiscard]] double first_share(Function&& function) const {
        for (int n = 1; n <= 500; ++n) {
            const double share = n / 500.0;
            if (function(at(share)) > 0) return share;
        }
        return 2;
    }
};

Oscillator<double> soft(double stiffness = 40, double damping = 1.5) {
    auto oscillator = paper_rig(beam_170mm, 2, 0.5);
    oscillator.damping_ratio = 0.05;
    oscillator.kelvin_voigt() = {stiffness, damping};
    return oscillator;
}

TEST(Extrapolated, IsTheMotionUpToItsFirstTermsLeftOut) {
    for (const double cubic : {0.0, 0.3}) {
        auto oscillator = soft();
        oscillator.cubic = cubic;
        const SundialsLeg leg{.oscillator = oscillator, .phase = Phase::contact, .start_angle = 0.7};
        LegPoint start{0.2, {0.3, -0.8}};
        start.flow << 1, 2, -1, 0.5;
        for (const double step : {2e-3, -2e-3}) {
            const LegPoint end = extrapolated(leg, start, step);
            const LegPoint exact = moved(leg, start, start.time + step, 10);
            EXPECT_NEAR(end.time, exact.time, 1e-15);
            EXPECT_NEAR(end.state[0], exact.state[0], 1e-9);
            EXPECT_NEAR(end.state[1], exact.state[1], 4e-7);
            EXPECT_LT((end.flow - exact.flow).norm(), cubic == 0 ? 6e-6 : 2e-5);
        }
    }
}

TEST(StepEvents, FindsATouchInFlight) {
    Trial trial(soft(), Phase::flight, {-0.2, 0.9}, 0.6);
    const auto event = trial.events.first_event();
    ASSERT_TRUE(event);
    EXPECT_EQ(event->next, Phase::contact);
    EXPECT_NEAR(event->point.state[0], 0, 1e-13);
    EXPECT_GT(event->point.state[1], 0);
    EXPECT_NEAR(event->point.time / 0.6, trial.first_share([](const auto& x) { return x[0]; }), 1.0 / 500);
    EXPECT_LT((event->point.state - moved(trial.leg, trial.stepper.from, event->point.time, 400).state).norm(),
              1e-9);
    EXPECT_FALSE(trial.events.failed());
    EXPECT_LT(trial.stepper.looks, 6);
}

TEST(StepEvents, FindsNoneInAFlightThatStaysBelow) {
    Trial trial(soft(), Phase::flight, {-0.8, 0.3}, 0.6);
    EXPECT_FALSE(trial.events.first_event());
}

// As a leg begins on the stop, up to rounding.
TEST(StepEvents, LeavesASurfaceWithoutAnEvent) {
    for (const double above : {0.0, 1e-17}) {
        Trial trial(soft(), Phase::flight, {above, -0.5}, 0.2);
        EXPECT_FALSE(trial.events.first_event());
    }
}

TEST(StepEvents, TrustsThatNothingHappensBeforeATime) {
    Trial trial(soft(), Phase::flight, {-0.2, 0.9}, 0.6);
    trial.events.trust_after(0.7);
    EXPECT_FALSE(trial.events.first_event());
    trial.events.trust_after(0.6);
    EXPECT_FALSE(trial.events.first_event());
    trial.events.trust_after(0.1);
    const auto event = trial.events.first_event();
    ASSERT_TRUE(event);
    EXPECT_NEAR(event->point.state[0], 0, 1e-13);
}

// The force falls to 0 before delta does.
TEST(StepEvents, FindsAReleaseInContact) {
    const auto oscillator = soft();
    Trial trial(oscillator, Phase::contact, {0.05, -0.4}, 0.3);
    const auto event = trial.events.first_event();
    ASSERT_TRUE(event);
    EXPECT_EQ(event->next, Phase::unloaded);
    EXPECT_GT(event->point.state[0], 0);
    EXPECT_NEAR(40 * event->point.state[0] + 1.5 * event->point.state[1], 0, 1e-12);
    const auto pulls = [](const State<double>& x) { return -(40 * x[0] + 1.5 * x[1]); };
    EXPECT_NEAR(event->point.time / 0.3, trial.first_share(pulls), 1.0 / 500);
}

// Without damping the force falls to 0 at delta = 0.
TEST(StepEvents, FindsTheEndOfAContactWithAnElasticStop) {
    Trial trial(soft(40, 0), Phase::contact, {0.05, -0.4}, 0.3);
    const auto event = trial.events.first_event();
    ASSERT_TRUE(event);
    EXPECT_EQ(event->next, Phase::flight);
    EXPECT_NEAR(event->point.state[0], 0, 1e-13);
    EXPECT_LT(event->point.state[1], 0);
}

TEST(StepEvents, FindsTheEarlierOfTwoEventsWhileUnloaded) {
    const auto oscillator = soft();
    const auto presses = [](const State<double>& x) { return 40 * x[0] + 1.5 * x[1]; };
    {
        Trial away(oscillator, Phase::unloaded, {0.01, -0.5}, 0.2);
        const auto event = away.events.first_event();
        ASSERT_TRUE(event);
        EXPECT_EQ(event->next, Phase::flight);
        EXPECT_NEAR(event->point.state[0], 0, 1e-13);
    }
    auto driven = oscillator;
    driven.frequency = 6;
    Trial back(driven, Phase::unloaded, {0.2, -5.9}, 0.35);
    ASSERT_GT(back.first_share([](const auto& x) { return -x[0]; }), 0);
    const auto event = back.events.first_event();
    const double resumes = back.first_share(presses);
    const double leaves = back.first_share([](const auto& x) { return -x[0]; });
    if (std::min(resumes, leaves) > 1) {
        EXPECT_FALSE(event);
    } else {
        ASSERT_TRUE(event);
        EXPECT_EQ(event->next, resumes < leaves ? Phase::contact : Phase::flight);
        EXPECT_NEAR(event->point.time / 0.35, std::min(resumes, leaves), 1.0 / 500);
    }
}

TEST(StepEvents, MeasuresTheLargestForceOfAStep) {
    Trial trial(soft(), Phase::contact, {0.0, 0.9}, 0.4);
    double largest = 0;
    for (int n = 0; n <= 500; ++n) {
        const State<double> x = trial.at(n / 500.0);
        largest = std::max(largest, 40 * x[0] + 1.5 * x[1]);
    }
    EXPECT_NEAR(trial.events.largest_force(trial.stepper.to, 0), largest, 1e-5 * largest);
    EXPECT_EQ(trial.events.largest_force(trial.stepper.to, 2 * largest), 2 * largest);
    // of no length, as where an event begins the step
    EXPECT_NEAR(trial.events.largest_force(trial.stepper.from, 0), 1.5 * 0.9, 1e-14);
    EXPECT_EQ(trial.events.largest_force(trial.stepper.from, 2), 2);
}

TEST(StepEvents, MeasuresTheLargestDisplacementOnEitherSide) {
    for (const double side : {1.0, -1.0}) {
        auto oscillator = soft();
        oscillator.gap = 3;
        oscillator.frequency = 0;  // a cart at rest
        Trial trial(oscillator, Phase::flight, {side * 1.2 - 3, side * 0.9}, 1.3);
        double largest = 0;
        for (int n = 0; n <= 500; ++n) largest = std::max(largest, std::abs(trial.at(n / 500.0)[0] + 3));
        ASSERT_GT(largest, std::max(1.2, std::abs(trial.stepper.to.state[0] + 3)) + 0.01);
        EXPECT_NEAR(trial.events.largest_displacement(trial.stepper.to, 0), largest, 1e-5);
        EXPECT_EQ(trial.events.largest_displacement(trial.stepper.to, 9), 9);
        EXPECT_NEAR(trial.events.largest_displacement(trial.stepper.from, 0), 1.2, 1e-14);
        const double bound = trial.events.displacement_bound(trial.stepper.to, 0);
        EXPECT_GE(bound, largest);
        EXPECT_LT(bound, 1.5 * largest);
        EXPECT_EQ(trial.events.displacement_bound(trial.stepper.to, 9), 9);
        EXPECT_NEAR(trial.events.displacement_bound(trial.stepper.from, 0), 1.2, 1e-14);
    }
}

TEST(StepEvents, IntegratesWorkOverAStep) {
    auto oscillator = soft();
    oscillator.cubic = 0.2;
    Trial trial(oscillator, Phase::contact, {0.02, 0.5}, 0.25, 0.3);
    StepEvents<SmallSteps>::Integrals sum{.push = 1, .push_work = 2, .drive_work = 3, .damper_work = 4};
    trial.events.add_integrals(trial.stepper.to, sum);
    StepEvents<SmallSteps>::Integrals fine;
    constexpr int parts = 500;
    for (int n = 0; n < parts; ++n) {
        const double time = 0.3 + 0.25 * (n + 0.5) / parts;
        const State<double> x = trial.at((n + 0.5) / parts);
        const double angle = 0.4 + 2 * time;
        const double u = x[0] + 0.5;
        const double drive = 4 * std::sin(angle);
        const double push = drive - 2 * 0.05 * x[1] - u - 0.2 * u * u * u;
        const double weight = 0.25 / parts;
        fine.push += weight * push;
        fine.push_work += weight * push * x[1];
        fine.drive_work += weight * drive * x[1];
        fine.damper_work += weight * 2 * 0.05 * x[1] * x[1];
    }
    EXPECT_NEAR(sum.push, 1 + fine.push, 1e-6);
    EXPECT_NEAR(sum.push_work, 2 + fine.push_work, 1e-6);
    EXPECT_NEAR(sum.drive_work, 3 + fine.drive_work, 1e-6);
    EXPECT_NEAR(sum.damper_work, 4 + fine.damper_work, 1e-6);
}

TEST(StepEvents, TellsOfALookThatFailed) {
    Trial trial(soft(), Phase::flight, {-0.2, 0.9}, 0.6);
    trial.stepper.sound = false;
    EXPECT_FALSE(trial.events.failed());
    static_cast<void>(trial.events.first_event());
    EXPECT_TRUE(trial.events.failed());
    trial.events.forget_failure();
    EXPECT_FALSE(trial.events.failed());
    EXPECT_EQ(trial.events.state_at(0.1), moved(trial.leg, trial.stepper.from, 0.1, 64).state);
    EXPECT_TRUE(trial.events.failed());
}

// A contact with a decay much faster than the step follows the balance of forces: it ends where spring, damper
// and drive pull the hammer off, although its state's own derivatives are noise.
TEST(StepEvents, FindsTheEndOfAContactWhoseFastDecayIsPassed) {
    auto oscillator = soft(3, 2000);
    Trial trial(oscillator, Phase::contact, {0.0004, 0}, 0.05, 1.3);
    ASSERT_GT(0.05 * trajectory::rates_of(trajectory::linearized_contact(oscillator, {0.0004, 0})).fast, 3);
    EXPECT_NEAR(trial.events.displacement_bound(trial.stepper.to, 0),
                std::max(0.5004, std::abs(trial.stepper.to.state[0] + 0.5)), 1e-15);
}

}  // namespace
}  // namespace peterka::integrators
