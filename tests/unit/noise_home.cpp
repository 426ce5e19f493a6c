#include "noise/home.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "noise_cases.hpp"
#include "rigid_rig.hpp"

namespace peterka::noise {
namespace {

using State = scene::State<double>;
using testing::white;

// A weakly damped linear oscillator under white noise has the stationary variances s^2/(4 zeta) of u and u', in
// units of omega = 1 (e.g. Gardiner 2009, Stochastic Methods, 4.4).
TEST(Home, AFreeMotionSpreadsAsInClosedForm) {
    const testing::Settled motion = testing::free_motion(1.5, 50);
    DisturbedMap map(motion.oscillator, {}, white(0.01));
    const auto home = Home::of(map, motion.point, 1);
    ASSERT_TRUE(home);
    const double variance = 1e-4 / (4 * motion.oscillator.damping_ratio);
    EXPECT_NEAR(home->covariance(0)(0, 0) / variance, 1, 1e-3);
    EXPECT_NEAR(home->covariance(0)(1, 1) / variance, 1, 1e-3);
    EXPECT_NEAR(home->covariance(0)(0, 1) / variance, 0, 1e-2);
    const double cycle = motion.oscillator.period();
    EXPECT_NEAR(1 / home->to_relax(), motion.oscillator.damping_ratio * cycle, 1e-9);
    EXPECT_EQ(home->radius(), 2);
}

// Of a long disturbed motion, by the points of the orbit that it passes in turn.
void expect_to_spread_as_seen(const testing::Settled& motion, const Disturbance& disturbance, int cycles) {
    DisturbedMap map(motion.oscillator, {}, disturbance);
    const auto home = Home::of(map, motion.point, motion.period);
    ASSERT_TRUE(home);
    std::vector<State> points{motion.point};
    while (std::ssize(points) < motion.period) points.push_back(*map.at_next_phase_0({points.back()}));
    std::vector<scene::Jacobian<double>> seen(points.size(), scene::Jacobian<double>::Zero());
    RandomNumbers random(11);
    DisturbedState disturbed{motion.point};
    for (int cycle = 1; cycle <= cycles * motion.period; ++cycle) {
        do {
            ASSERT_TRUE(map.advance(disturbed, random));
        } while (!disturbed.at_phase_0());
        const auto n = static_cast<std::size_t>(cycle % motion.period);
        const State off = disturbed.state - points[n];
        seen[n] += off * off.transpose() / cycles;
    }
    // each relaxation time tells something new
    const double independent = cycles * motion.period * (1 - std::exp(-1 / home->to_relax()));
    const double error = 5 * std::sqrt(2 / independent);
    for (int n = 0; n < motion.period; ++n) {
        const auto& expected = home->covariance(n);
        const auto& found = seen[static_cast<std::size_t>(n)];
        EXPECT_NEAR(found(0, 0) / expected(0, 0), 1, error) << n;
        EXPECT_NEAR(found(1, 1) / expected(1, 1), 1, error) << n;
    }
}

TEST(Home, OrbitsWithImpactsSpreadByWhiteNoise) {
    expect_to_spread_as_seen(
        testing::settled(peterka::testing::paper_rig(peterka::testing::beam_170mm, 2, 0), 0, 0), white(1e-3),
        2000);
    expect_to_spread_as_seen(testing::one_in_three(), white(1e-4), 2000);
}

TEST(Home, MotionsSpreadByDeviationsOfTheCart) {
    const testing::Settled strikes =
        testing::settled(peterka::testing::paper_rig(peterka::testing::beam_170mm, 2, 0), 0, 0);
    expect_to_spread_as_seen(strikes, {.amplitude = 1e-3}, 2000);
    expect_to_spread_as_seen(strikes, {.frequency = 1e-3}, 2000);
    expect_to_spread_as_seen(testing::free_motion(1.5, 50),
                             {.speed = 1e-3, .amplitude = 1e-3, .frequency = 1e-3}, 20'000);
}

TEST(Home, DistancesAreInStandardDeviations) {
    const testing::Settled motion = testing::one_in_three();
    DisturbedMap map(motion.oscillator, {}, white(1e-3));
    const auto home = Home::of(map, motion.point, 3);
    ASSERT_TRUE(home);
    const auto& covariance = home->covariance(0);
    EXPECT_EQ(home->distance(motion.point), 0);
    // along one axis the distance is by the deviation that is left if the other is known
    const double left = std::sqrt(covariance(0, 0) - covariance(0, 1) * covariance(0, 1) / covariance(1, 1));
    EXPECT_NEAR(home->distance(motion.point + State(0.7 * left, 0)), 0.7, 1e-6);
    const auto next = map.at_next_phase_0({motion.point});
    EXPECT_NEAR(home->distance(*next), 0, 1e-6);
}

TEST(Home, NoHomeOffAnOrbitOrOnAnUnstableOne) {
    const testing::Settled motion = testing::free_motion(1.5, 50);
    DisturbedMap map(motion.oscillator, {}, white(1e-3));
    EXPECT_TRUE(Home::of(map, motion.point, 1));
    EXPECT_FALSE(Home::of(map, motion.point + State(1e-2, 0), 1));
    const testing::Settled three = testing::one_in_three();
    DisturbedMap other(three.oscillator, {}, white(1e-3));
    EXPECT_FALSE(Home::of(other, three.point, 1));
    EXPECT_FALSE(Home::of(other, three.point, 2));
    // by its relaxation time in cycles
    const double relaxes = 1 / (motion.oscillator.damping_ratio * motion.oscillator.period());
    EXPECT_FALSE(Home::of(map, motion.point, 1, 0.99 * relaxes));
    EXPECT_TRUE(Home::of(map, motion.point, 1, 1.01 * relaxes));
    // without damping nothing shrinks
    scene::Oscillator<double> lossless = motion.oscillator;
    lossless.damping_ratio = 0;
    DisturbedMap ever(lossless, {}, white(1e-3));
    EXPECT_FALSE(Home::of(ever, State(-50, 1 / (1 - 2.25) * 2.25 * 1.5), 1));
}

TEST(Home, APointThatIsALittleOffIsThatOfTheSameHome) {
    const testing::Settled motion = testing::one_in_three();
    DisturbedMap map(motion.oscillator, {}, white(6e-3));
    const auto home = Home::of(map, motion.point, 3);
    const auto near = Home::of(map, motion.point + State(-1e-5, 2e-5), 3);
    ASSERT_TRUE(home && near);
    EXPECT_NEAR((near->first_point() - home->first_point()).norm(), 0, 1e-10);
    EXPECT_EQ(near->radius(), home->radius());
    EXPECT_EQ(home->radius(), 2);
}

TEST(Home, HomeEndsWhereTheBasinDoes) {
    const testing::Settled motion = testing::one_in_three();
    double last = 10;
    for (const double speed : {1e-3, 0.03, 0.12}) {
        DisturbedMap map(motion.oscillator, {}, white(speed));
        const auto home = Home::of(map, motion.point, 3);
        ASSERT_TRUE(home);
        EXPECT_LT(home->radius() * speed, 0.04);  // in a basin of a certain width
        EXPECT_LE(home->radius(), std::min(last, 2.0));
        last = home->radius();
    }
    EXPECT_LT(last, 0.5);
}

TEST(Home, TakesBackWhatIsNearAndNothingFromAnotherMotion) {
    const testing::Settled motion = testing::one_in_three();
    DisturbedMap map(motion.oscillator, {}, white(1e-2));
    const auto home = Home::of(map, motion.point, 3);
    ASSERT_TRUE(home);
    std::vector<State> elsewhere;
    EXPECT_TRUE(home->takes_back(map, motion.point + State(0.03, 0), elsewhere).value());
    const testing::Settled swing = testing::free_motion(1.5, 3);
    const testing::Settled strikes = testing::settled(swing.oscillator, -5, -1.4);
    ASSERT_GT((strikes.point - swing.point).norm(), 1);
    DisturbedMap both(swing.oscillator, {}, white(1e-3));
    const auto free = Home::of(both, swing.point, 1);
    ASSERT_TRUE(free);
    elsewhere.clear();
    EXPECT_FALSE(free->takes_back(both, strikes.point, elsewhere).value());
    EXPECT_TRUE(free->takes_back(both, swing.point, elsewhere).value());
    EXPECT_FALSE(elsewhere.empty());
    EXPECT_FALSE(free->takes_back(both, strikes.point, elsewhere).value());
}

// A stop without restitution that presses at phase 0 holds the hammer there, whatever disturbed it before.
TEST(Home, AHammerHeldByTheStopIsAtHomeThereAlone) {
    const scene::Oscillator<double> oscillator = peterka::testing::rigid(0, 0.6, -0.3, 0.05);
    DisturbedMap map(oscillator, {}, white(0.01));
    State state(0, 0);
    for (int n = 0; n < 20; ++n) state = *map.at_next_phase_0({state});
    ASSERT_EQ(state, State(0, 0));
    const auto home = Home::of(map, state, 1);
    ASSERT_TRUE(home);
    EXPECT_EQ(home->covariance(0), scene::Jacobian<double>::Zero());
    EXPECT_EQ(home->distance(state), 0);
    EXPECT_LT(home->distance(State(-1e-8, 1e-8)), 1);
    EXPECT_GT(home->distance(State(0, -1e-3)), 1e3);
    EXPECT_GT(home->distance(State(-1e-3, 0)), 1e3);
}

// Of this basin 4 or 5 in a thousand states half a standard deviation away return only after more than 500
// cycles, by a chaotic transient.
TEST(Home, DoesNotEndWhereAStateTakesLongToReturn) {
    const scene::Oscillator<double> oscillator{.damping_ratio = 0.03,
                                               .contact = scene::KelvinVoigt<double>{50, 1.27324},
                                               .frequency = 2.3,
                                               .gap = 1.8};
    for (int n = 0; n < 60; ++n) {
        DisturbedMap map(oscillator, {}, {.amplitude = 0.05, .frequency = 0.01});
        const auto home = Home::of(map, {-5.3335382, -5.2038602 + 1e-9 * n}, 2);
        ASSERT_TRUE(home) << n;
        EXPECT_EQ(home->radius(), 0.5) << n;
    }
}

TEST(Home, HowManyStatesReturnIsToldByOneOfThem) {
    const testing::Settled motion = testing::one_in_three();
    DisturbedMap map(motion.oscillator, {}, white(0.001));
    const auto home = Home::of(map, motion.point, motion.period);
    ASSERT_TRUE(home);
    std::vector<State> elsewhere;
    State far = motion.point;
    while (home->takes_back(map, far, elsewhere).value()) far[1] += 0.1;
    const std::vector<State> states{motion.point, far, far, far};
    RandomNumbers random(1);
    constexpr int tries = 2000;
    int all = 0;
    for (int n = 0; n < tries; ++n) {
        const std::int64_t told = home->returning(map, states, random, elsewhere);
        ASSERT_TRUE(told == 0 || told == 4);
        all += told == 4 ? 1 : 0;
    }
    EXPECT_NEAR(4.0 * all / tries, 1, 4 * 4 * std::sqrt(0.25 * 0.75 / tries));
    EXPECT_EQ(home->returning(map, {}, random, elsewhere), 0);
}

}  // namespace
}  // namespace peterka::noise
