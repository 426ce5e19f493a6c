// Newton's method on the stroboscopic map.
#include "regime/periodic_orbit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>

#include "certificate/certify.hpp"
#include "certified_cells.hpp"
#include "regime/scalar_engine.hpp"
#include "rig.hpp"

namespace peterka::regime {
namespace {

// Not the lowest velocity, also where that is lower than each position.
TEST(PeriodicOrbit, BeginsAtItsLowestPoint) {
    PeriodicOrbit orbit;
    orbit.points = {Point(1, -5), Point(2, 4), Point(0, 3)};
    EXPECT_EQ(put_lowest_point_first(orbit), 2U);
    EXPECT_EQ(orbit.points, (Points{Point(0, 3), Point(1, -5), Point(2, 4)}));
}

// From the stable 1/1 at 2.5 on, with each orbit as the initial guess for the next.
struct Followed {
    std::optional<PeriodicOrbit> orbit;
    std::int64_t cycles = 0;  // spent on the last one
};
Followed follow_one_a_cycle(double last_frequency, double most_stretch) {
    constexpr double first_frequency = 2.5;
    constexpr int steps = 10;
    auto oscillator = testing::paper_rig(testing::beam_170mm, first_frequency, 0);
    const CellResult stable = find_steady_state(oscillator, testing::start_at(oscillator), {});
    EXPECT_EQ(stable.regime, Regime::periodic);
    scene::State<double> point(stable.orbit_displacement - oscillator.gap, stable.orbit_velocity);
    Followed followed;
    for (int step = 1; step <= steps; ++step) {
        oscillator.frequency = first_frequency + (last_frequency - first_frequency) * step / steps;
        const bool last = step == steps;
        CycleBroker broker;
        StroboscopicMap map(oscillator, {}, broker);
        followed.orbit = last ? complete(find_orbit(map, Points{map.scaled(point)}, most_stretch), broker)
                              : complete(find_orbit(map, Points{map.scaled(point)}), broker);
        followed.cycles = map.cycles_spent();
        if (!followed.orbit) break;
        point = map.unscaled(followed.orbit->point());
    }
    return followed;
}

TEST(FindOrbit, ReachesUnstableOrbitsToo) {
    const auto [orbit, cycles] = follow_one_a_cycle(3.1, std::numeric_limits<double>::infinity());
    ASSERT_TRUE(orbit);
    EXPECT_GT(orbit->multiplier, 1.5);  // the period doubles at 2.659
    EXPECT_FALSE(is_stable(*orbit));
    EXPECT_GT(cycles, 1);
}

TEST(FindOrbit, GivesUpAfterTheFirstPassWhereThatStretches) {
    const auto [orbit, cycles] = follow_one_a_cycle(3.1, 1.2);
    EXPECT_FALSE(orbit);
    EXPECT_EQ(cycles, 1);
}

TEST(FindOrbit, GoesOnWhereItContracts) {
    const auto [orbit, cycles] = follow_one_a_cycle(2.6, 1.2);
    ASSERT_TRUE(orbit);
    EXPECT_TRUE(is_stable(*orbit));
}

// Period 25, along which errors grow a millionfold: two starts from which
// single shooting gave forces of 51.988839 and 51.988565 and multipliers of
// 0.86566 and 0.85018. The reference values are from an independent program.
TEST(FindOrbit, ALongOrbitIsTheSameFromEveryStart) {
    const double omega = 2 * std::numbers::pi * 4.5;
    auto oscillator = testing::paper_rig(testing::beam_170mm, 4.4, 1.4762520450293801);
    oscillator.damping_ratio = 0.033703005987711296 / (2 * 0.298 * omega);
    oscillator.kelvin_voigt().damping = 600 / (0.298 * omega);
    const double force_ratio = 0.298 * omega * omega * 0.89e-3 / (0.298 * 9.80665);  // of k A0 over the weight
    for (const auto& [x, v] : {std::pair{-3.389245317608788, 4.476190476190476},
                               {-3.0, 0.0},
                               {-3.001, 0.0},
                               {-3.002, 0.0},
                               {-3.003, 0.0},
                               {-3.004, 0.0}}) {
        // so long that no chaotic transient, of which rounding decides, is taken for chaos
        const CellResult cell = find_steady_state(oscillator, {x - oscillator.gap, v - oscillator.frequency},
                                                  {.max_cycles = 200'000, .chaos_cycles = 100'000});
        ASSERT_EQ(cell.regime, Regime::periodic);
        EXPECT_EQ(cell.impacts, 25);
        EXPECT_EQ(cell.period, 42);
        EXPECT_NEAR(cell.peak_force * force_ratio, 51.9885631765, 1e-7);  // rounding, a millionfold
        EXPECT_NEAR(cell.multiplier, 0.8500762, 5e-6);
    }
}

// A deviation that turns by 80 degrees a period and hardly shrinks; a contact is missed where it points
// downwards by more than `room`.
struct Spiral {
    explicit Spiral(double contraction) {
        const double angle = 80 * std::numbers::pi / 180;
        orbit.points = {Point(1, 0)};
        orbit.jacobian << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
        orbit.jacobian *= contraction;
        orbit.multiplier = contraction;
    }
    // What a test tells of a trajectory, and after how many periods.
    [[nodiscard]] std::pair<ConvergenceTest::Standing, int> follow(double room) const {
        Point deviation(0.01, 0);
        ConvergenceTest test(orbit, orbit.point() + deviation, 0);
        for (int periods = 1;; ++periods) {
            const EventPattern pattern = deviation[1] < -room ? 1 : 0;
            deviation = orbit.jacobian * deviation;
            const auto standing = test.advance(orbit.point() + deviation, pattern);
            if (standing != ConvergenceTest::Standing::open) return {standing, periods};
        }
    }
    PeriodicOrbit orbit;
};

TEST(ConvergenceTest, ADeviationThatTurnsIsFollowedAllAround) {
    const Spiral slow(0.995);
    const auto [missed, early] = slow.follow(0.005);  // the fourth deviation points there
    EXPECT_EQ(missed, ConvergenceTest::Standing::refuted);
    EXPECT_EQ(early, 4);
    const auto [proved, later] = slow.follow(0.02);
    EXPECT_EQ(proved, ConvergenceTest::Standing::proved);
    EXPECT_GT(later, 4);  // a turn is four and a half periods
    EXPECT_LT(later, 20);
    const Spiral fast(0.1);
    EXPECT_LT(fast.follow(0.02).second, 9);  // rests before
    Spiral straight(0.995);
    straight.orbit.jacobian = Eigen::Vector2d(0.995, 0.1).asDiagonal();
    EXPECT_EQ(straight.follow(0.02), std::pair(ConvergenceTest::Standing::proved, 2));
}

// With its cubic spring, however weak, the free hammer's decaying swing looks settled after ten cycles; it
// reaches the stop two cycles later. 2/3 and the way to it are proved in interval arithmetic, too.
TEST(ConvergenceTest, ASwingThatYetReachesTheStopIsNotTakenForFree) {
    job::CellNumbers numbers = testing::numbers_170mm(4.331578947368421, 1.1578947368421053);
    numbers.hammer.cubic_stiffness_n_per_m3 = 238.23;
    scene::Oscillator<double> oscillator =
        testing::paper_rig(testing::beam_170mm, 4.331578947368421, 1.1578947368421053);
    oscillator.cubic = testing::paper_cubic;
    const CellResult result = testing::solve(oscillator);
    EXPECT_EQ(result.regime, Regime::periodic);
    EXPECT_EQ(result.impacts, 2);
    EXPECT_EQ(result.period, 3);
    const certificate::Claim claim{
        result.regime, {result.impacts, result.period, result.orbit_displacement, result.orbit_velocity}};
    EXPECT_EQ(certificate::certify(numbers, claim, certificate::OfStart::through_impacts).verdict,
              cell::Certified::start);
}

}  // namespace
}  // namespace peterka::regime
