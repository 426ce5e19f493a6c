// Quantities recorded for Kelvin-Voigt contacts, against formulas, balances and direct summation.
#include "trajectory/recorder.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "rig.hpp"
#include "trajectory/exact_cycle_map.hpp"
#include "trajectory/split_cycle_map.hpp"

namespace peterka::trajectory {
namespace {

using testing::beam_170mm;
using testing::paper_rig;

struct RecordedCollision {
    double damping_ratio;  // of the contact
    double restitution;
};

class RecordedImpact : public ::testing::TestWithParam<RecordedCollision> {};

// So stiff a stop that the beam spring and the cart have no effect during the collision.
TEST_P(RecordedImpact, IsThatOfAFreeMass) {
    constexpr double stiffness = 1e26;
    const auto [zeta, restitution] = GetParam();
    const scene::Oscillator<double> oscillator{
        .damping_ratio = 0.05,
        .contact = scene::KelvinVoigt<double>{stiffness, 2 * zeta * std::sqrt(stiffness)},
        .frequency = 0.1,
        .gap = 0};
    const LinearLegs<double> legs(oscillator);
    Journey<double> journey(oscillator, {-1e-4, 1});
    Recorder<double> recorder(Detail::contacts);
    ASSERT_TRUE(legs.run(journey, 1e-3, &recorder));
    const auto& totals = recorder.totals();
    ASSERT_EQ(totals.impacts, 1);
    const double speed = totals.impact_speed;
    EXPECT_NEAR(speed, 1, 1e-4);
    EXPECT_NEAR(totals.impulse / (1 + restitution) / speed, 1, 1e-12);
    EXPECT_NEAR(totals.contact_work, (1 - restitution * restitution) * speed * speed / 2, 1e-12);
    if (zeta < 1) {
        const double duration = 2 * std::acos(zeta) / std::sqrt(stiffness * (1 - zeta * zeta));
        EXPECT_NEAR(totals.contact_time / duration, 1, 1e-12);
    }
}

INSTANTIATE_TEST_SUITE_P(DampingRatios, RecordedImpact,
                         ::testing::Values(RecordedCollision{0, 1}, RecordedCollision{0.1, 0.74407939772178},
                                           RecordedCollision{0.2, 0.57174002758478},
                                           RecordedCollision{0.5, 0.29843605919227},
                                           RecordedCollision{1, std::exp(-2.0)},
                                           RecordedCollision{2, 0.04776873250562}));

// Over any number of cycles: the change of energy equals the drive's work minus the dissipation of damper and
// stop. The impulses of the impacts equal the change of momentum not due to spring, damper and drive.
TEST(Recorder, BalancesEnergy) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> frequency(0.3, 4.5);
    std::uniform_real_distribution<double> gap(-2, 2);
    std::normal_distribution<double> state(0, 3);
    std::int64_t impacts = 0;
    for (int n = 0; n < 200; ++n) {
        auto oscillator = paper_rig(beam_170mm, frequency(random), gap(random));
        if (n % 5 == 1) oscillator.kelvin_voigt().damping *= 12;                     // overdamped
        if (n % 5 == 2) oscillator.kelvin_voigt().damping = 0;                       // elastic
        if (n % 5 == 3) oscillator.contact = scene::KelvinVoigt<double>{3, 0.4};     // soft
        if (n % 5 == 4) oscillator.contact = scene::KelvinVoigt<double>{1e12, 2e8};  // zeta_i = 100
        const ExactCycleMap<double> map(oscillator);
        Recorder<double> recorder(Detail::energy);
        State<double> x(-oscillator.gap - std::abs(state(random)), state(random));
        x[0] = std::min(x[0], -1e-3);
        const auto energy = [&] {  // energy of hammer and beam springs, plus the stop's spring while compressed
            const double u = x[0] + oscillator.gap;
            return (x[1] * x[1] + u * u) / 2;
        };
        const double before = energy();
        double exchanged = std::abs(before);
        for (int cycle = 0; cycle < 4; ++cycle) {
            const auto passed = map(x, &recorder);
            ASSERT_EQ(passed.outcome, Cycle<double>::Outcome::done);
            x = passed.end;
        }
        const auto& totals = recorder.totals();
        exchanged +=
            std::abs(totals.drive_work) + totals.damper_work + std::abs(totals.contact_work) + energy();
        EXPECT_NEAR(energy() - before, totals.drive_work - totals.damper_work - totals.contact_work,
                    2e-12 * exchanged)
            << n << " " << oscillator.frequency << " " << oscillator.gap;
        impacts += totals.impacts;
    }
    EXPECT_GT(impacts, 400);
}

// One impact from first touch to flight, with spring, damper and drive integrated by summation.
TEST(Recorder, ImpulseIsTheChangeOfMomentum) {
    auto oscillator = paper_rig(beam_170mm, 1.7, 0.3);
    oscillator.contact = scene::KelvinVoigt<double>{40, 1};
    const ExactCycleMap<double> map(oscillator);
    Recorder<double> recorder(Detail::contacts);
    State<double> x(-2.0, 5.0);
    const auto cycle = map(x, &recorder);
    ASSERT_EQ(cycle.impacts, 1);
    // u'' = eta^2 sin(theta) - 2 zeta u' - u - f, and sin(theta) has no mean over the cycle
    constexpr int steps = 200'000;
    double sum_of_u = 0;
    State<double> at = x;
    // the cycle by the classical Runge-Kutta method, with an error of about one step at each event
    const double h = oscillator.period() / steps;
    const auto slope = [&](const State<double>& s, double t) {
        const auto phase = phase_of(oscillator, s);
        const double f = phase == Phase::contact ? contact_force(oscillator, s) : 0;
        return State<double>(s[1], oscillator.drive() * std::sin(oscillator.frequency * t) -
                                       2 * oscillator.damping_ratio * s[1] - s[0] - oscillator.gap - f);
    };
    for (int n = 0; n < steps; ++n) {
        const double t = n * h;
        const State<double> a = slope(at, t), b = slope(at + h / 2 * a, t + h / 2),
                            c = slope(at + h / 2 * b, t + h / 2), d = slope(at + h * c, t + h);
        const State<double> next = at + h / 6 * (a + 2 * b + 2 * c + d);
        sum_of_u += h * ((at[0] + next[0]) / 2 + oscillator.gap);
        at = next;
    }
    const double impulse =
        -(cycle.end[1] - x[1]) - 2 * oscillator.damping_ratio * (cycle.end[0] - x[0]) - sum_of_u;
    EXPECT_NEAR(recorder.totals().impulse, impulse, 2e-4 * impulse);
}

// A hammer in contact at phase 0: the impact that spans it counts once, and completely.
TEST(Recorder, ImpactsMayLastAcrossTheEndOfACycle) {
    auto oscillator = paper_rig(beam_170mm, 0.75, -0.5);
    oscillator.damping_ratio = 0.02;
    oscillator.contact = scene::KelvinVoigt<double>{15, 0.5};
    const ExactCycleMap<double> map(oscillator);
    State<double> x(0, 0);
    for (int n = 0; n < 3000; ++n) x = map(x).end;
    ASSERT_EQ(phase_of(oscillator, x), Phase::contact);

    Recorder<double> recorder(Detail::contacts);
    EXPECT_LT((map(x, &recorder).end - x).norm(), 1e-10);
    ASSERT_TRUE(recorder.is_open());
    recorder.reset_totals();
    std::ignore = map(x, &recorder);
    const auto& totals = recorder.totals();
    EXPECT_EQ(totals.impacts, 1);

    // the same orbit from its first touch on, step by step
    const motion::LinearMotion<double> flight(motion::flight_equation(oscillator));
    const motion::LinearMotion<double> contact(motion::contact_equation(oscillator));
    const Probe<double> release({.position = -15, .velocity = -0.5}, contact);
    const Leg<double> first(contact, x, 0);
    const auto out = first_crossing(first, release, first.start(), oscillator.period());
    ASSERT_EQ(out.ending, Crossing<double>::Ending::crossing);
    const Leg<double> back(flight, out.moment.state, oscillator.frequency * out.moment.time);
    const Probe<double> touch({.position = 1}, flight);
    const auto left = first_crossing(back, Probe<double>({.position = -1}, flight), back.start(), 10.0);
    const auto in = first_crossing(back, touch, left.moment, oscillator.period());
    ASSERT_EQ(in.ending, Crossing<double>::Ending::crossing);
    const double duration = oscillator.period() - in.moment.time;
    EXPECT_NEAR(totals.contact_time, duration, 1e-9);
    EXPECT_NEAR(totals.impact_speed, in.moment.state[1], 1e-9);

    // midpoint sums
    const Leg<double> pressed(contact, {0, in.moment.state[1]},
                              oscillator.frequency * (out.moment.time + in.moment.time));
    double impulse = 0;
    constexpr int points = 200'000;
    for (int n = 0; n < points; ++n) {
        impulse +=
            contact_force(oscillator, pressed.at((n + 0.5) * duration / points).state) * duration / points;
    }
    EXPECT_NEAR(totals.impulse, impulse, 1e-8 * impulse);
}

TEST(Recorder, LargestDisplacementIsAMaximumAndTheBoundIsAbove) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> frequency(0.3, 4.5);
    std::normal_distribution<double> state(0, 3);
    for (int n = 0; n < 50; ++n) {
        auto oscillator = paper_rig(beam_170mm, frequency(random), 0.5);
        if (n % 2 == 0) oscillator.contact = scene::KelvinVoigt<double>{10, 0.1};
        const State<double> x(-2 - std::abs(state(random)), state(random));
        Recorder<double> recorder(Detail::contacts);
        std::ignore = ExactCycleMap<double>(oscillator)(x, &recorder);
        // the split map of a vanishing cubic stops at every 1/400 of the cycle
        oscillator.cubic = 1e-300;
        Recorder<double> fine(Detail::contacts);
        std::ignore = SplitCycleMap<double>(oscillator, 400)(x, &fine);
        const double largest = recorder.totals().largest_displacement;
        EXPECT_GE(largest, std::abs(x[0] + oscillator.gap));
        EXPECT_NEAR(largest, fine.totals().largest_displacement, 1e-11 * largest);
        EXPECT_NEAR(recorder.totals().impulse, fine.totals().impulse, 1e-10 * largest);
        EXPECT_NEAR(recorder.totals().contact_work, fine.totals().contact_work, 1e-10 * largest * largest);
        EXPECT_LE(largest, recorder.totals().displacement_bound * (1 + 1e-12));
    }
}

TEST(Recorder, ResultsOfACellCarryWhatWasAskedFor) {
    const auto oscillator = paper_rig(beam_170mm, 2.0, 0.0);
    const auto start = testing::start_at(oscillator);
    const auto plain = regime::find_steady_state(oscillator, start, {});
    EXPECT_TRUE(std::isnan(plain.impulse));
    EXPECT_TRUE(std::isnan(plain.max_displacement));
    const auto cell = regime::find_steady_state(oscillator, start, {}, {}, {.detail = Detail::contacts});
    EXPECT_EQ(cell.peak_force, plain.peak_force);
    EXPECT_FALSE(cell.chatter);
    // a periodic orbit: the stop dissipates the drive's work minus the dissipation of the springs' damper
    Recorder<double> recorder(Detail::energy);
    const ExactCycleMap<double> map(oscillator);
    State<double> x(cell.orbit_displacement - oscillator.gap, cell.orbit_velocity);
    std::ignore = map(x, &recorder);
    const auto& totals = recorder.totals();
    EXPECT_NEAR(cell.contact_power * oscillator.period(), totals.drive_work - totals.damper_work,
                1e-11 * totals.drive_work);
    EXPECT_NEAR(cell.impact_speed, totals.impact_speed, 1e-10 * totals.impact_speed);
    EXPECT_NEAR(cell.impulse, totals.impulse, 1e-10 * totals.impulse);
    EXPECT_LE(cell.max_displacement, cell.largest_displacement);

    const auto free = regime::find_steady_state(paper_rig(beam_170mm, 2.0, 4.0), {-4, -2}, {}, {},
                                                {.detail = Detail::contacts});
    ASSERT_EQ(free.regime, regime::Regime::no_impact);
    EXPECT_EQ(free.impulse, 0);
    EXPECT_EQ(free.contact_power, 0);
    EXPECT_NEAR(free.max_displacement, testing::free_amplitude(paper_rig(beam_170mm, 2.0, 4.0)), 1e-9);
}

}  // namespace
}  // namespace peterka::trajectory
