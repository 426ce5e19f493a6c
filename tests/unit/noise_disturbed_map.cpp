#include "noise/disturbed_map.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "job/cell_numbers.hpp"
#include "noise_cases.hpp"
#include "rigid_rig.hpp"
#include "scene/scales.hpp"

namespace peterka::noise {
namespace {

using State = scene::State<double>;
using testing::white;

State whole_cycle(const scene::Oscillator<double>& oscillator, const State& from) {
    auto map = regime::make_cycle_map(oscillator, {});
    return std::visit([&](auto& engine) -> trajectory::Cycle<double> { return engine(from, nullptr); }, map)
        .end;
}

TEST(DisturbedMap, WithoutDisturbancesItsPartsAreTheWholeCycle) {
    std::vector<scene::Oscillator<double>> oscillators{
        peterka::testing::paper_rig(peterka::testing::beam_170mm, 2, 0),
        peterka::testing::paper_rig(peterka::testing::beam_170mm, 0.3, 0.1),
        peterka::testing::rigid(0.7, 2, 0.5), peterka::testing::rigid(0.2, 2, 0),
        peterka::testing::rigid(0, 2, 0.3)};
    for (const auto& oscillator : oscillators) {
        DisturbedMap map(oscillator, {}, {});
        RandomNumbers random(1);
        DisturbedState motion{State(-1, 0.5)};
        State expected = motion.state;
        for (int cycle = 0; cycle < 5; ++cycle) {
            expected = whole_cycle(oscillator, expected);
            do {
                ASSERT_TRUE(map.advance(motion, random));
            } while (!motion.at_phase_0());
            EXPECT_NEAR(motion.state[0], expected[0], 1e-8) << cycle << " of " << oscillator.frequency;
            EXPECT_NEAR(motion.state[1], expected[1], 1e-8) << cycle << " of " << oscillator.frequency;
        }
    }
}

TEST(DisturbedMap, ChangesAreDenseForTheHammerAndForTheForcing) {
    for (const double frequency : {0.05, 0.3, 1.0, 4.0}) {
        const auto oscillator = peterka::testing::paper_rig(peterka::testing::beam_170mm, frequency, 1);
        const int changes = DisturbedMap(oscillator, {}, {}).changes_per_cycle();
        EXPECT_GE(changes, 16);
        EXPECT_LE(oscillator.period() / changes, std::numbers::pi / 4);
        EXPECT_TRUE(changes == 16 || oscillator.period() / (changes - 1) > std::numbers::pi / 4);
    }
}

// The same hammer on a cart of another amplitude and frequency, as a job gives it, in metres and metres per
// second.
TEST(DisturbedMap, ACartThatDeviatesIsThatOfAnotherJob) {
    for (const bool is_hertz : {false, true}) {
        job::Job job = peterka::testing::job_170mm(is_hertz ? 1e7 : 0);  // the closed form has no cubic
        if (is_hertz) {
            job.contact =
                job::HuntCrossley{.stiffness_n_per_m_pow_n = 4e7, .exponent = 1.5, .dissipation_s_per_m = 2};
        }
        const regime::EngineSettings settings{
            .engine = is_hertz ? regime::Engine::cvode : regime::Engine::exact, .tolerance = 1e-11};
        const Deviations deviations{.amplitude = 0.07, .frequency = -0.03};
        const auto oscillator_of = [](const job::Job& from, double frequency_hz, double gap_m) {
            scene::Oscillator<double> oscillator = scene::oscillator_of(from);
            oscillator.frequency = frequency_hz / 4.5;
            oscillator.gap = gap_m / from.cart.amplitude_m;
            return oscillator;
        };
        const double gap_m = 0.4e-3;
        const double hertz = 8;
        DisturbedMap map(oscillator_of(job, hertz, gap_m), settings, {});
        job::Job other = job;
        other.cart.amplitude_m *= 1.07;
        const double other_hertz = hertz * 0.97;
        auto other_map = regime::make_cycle_map(oscillator_of(other, other_hertz, gap_m), settings);

        const double omega = 2 * std::numbers::pi * 4.5;
        const double x_m = -0.9e-3;     // of the hammer, relative to the cart, which passes its middle
        const double own_speed = 0.03;  // of the hammer, not relative [m/s]
        const auto relative = [&](double amplitude_m, double frequency_hz) {
            return own_speed - amplitude_m * 2 * std::numbers::pi * frequency_hz;
        };
        const auto state_in = [&](double amplitude_m, double frequency_hz) {
            return State((x_m - gap_m) / amplitude_m,
                         relative(amplitude_m, frequency_hz) / (amplitude_m * omega));
        };
        const double a = job.cart.amplitude_m;
        const double b = other.cart.amplitude_m;
        const auto end = map.deviating(state_in(a, hertz), deviations);
        ASSERT_TRUE(end);
        const State expected = std::visit(
                                   [&](auto& engine) -> trajectory::Cycle<double> {
                                       return engine(state_in(b, other_hertz), nullptr);
                                   },
                                   other_map)
                                   .end;
        const double other_speed = expected[1] * b * omega + b * 2 * std::numbers::pi * other_hertz;
        const double speed = (*end)[1] * a * omega + a * 2 * std::numbers::pi * hertz;
        const double tolerance = is_hertz ? 1e-8 : 1e-11;
        EXPECT_NEAR((*end)[0] * a, expected[0] * b, tolerance * a);
        EXPECT_NEAR(speed, other_speed, tolerance * a * omega);
    }
}

// Up to the largest reach for which springs can be kicks: a larger swing of the cart is no larger in its
// lengths.
TEST(DisturbedMap, ACartThatSwingsFurtherTakesNoMoreKicks) {
    scene::Oscillator<double> oscillator = testing::one_in_three().oscillator;
    oscillator.cubic = 1e-4;
    const auto follows = [&](double reach, double amplitude) {
        DisturbedMap map(oscillator, {.engine = regime::Engine::split, .largest_displacement = reach}, {});
        return map.deviating({-2, 1}, {amplitude, 0}).has_value();
    };
    double largest = 0.1;
    while (follows(1.01 * largest, 0)) largest *= 1.01;
    ASSERT_GT(largest, 0.2);
    ASSERT_LT(largest, 1e4);
    EXPECT_TRUE(follows(largest, 0.1));
}

// Far from the stop the motion is linear, so that the first order is all.
TEST(DisturbedMap, ManyCyclesSpreadByTheCovarianceOfTheLinearizedOne) {
    const testing::Settled motion = testing::free_motion(1.5, 50);
    DisturbedMap map(motion.oscillator, {}, white(0.2));
    const auto linear = map.linear(motion.point);
    ASSERT_TRUE(linear);
    RandomNumbers random(7);
    constexpr int count = 20'000;
    scene::Jacobian<double> covariance = scene::Jacobian<double>::Zero();
    for (int n = 0; n < count; ++n) {
        DisturbedState disturbed{motion.point};
        do {
            ASSERT_TRUE(map.advance(disturbed, random));
        } while (!disturbed.at_phase_0());
        const State off = disturbed.state - motion.point;
        covariance += off * off.transpose() / count;
    }
    const double error = 4 * std::sqrt(2.0 / count);
    EXPECT_NEAR(covariance(0, 0) / linear->covariance(0, 0), 1, error);
    EXPECT_NEAR(covariance(1, 1) / linear->covariance(1, 1), 1, error);
    EXPECT_NEAR(covariance(0, 1) / std::sqrt(covariance(0, 0) * covariance(1, 1)),
                linear->covariance(0, 1) / std::sqrt(linear->covariance(0, 0) * linear->covariance(1, 1)),
                error);
}

TEST(DisturbedMap, TheStateAtTheNextPhase0IsThatWithoutFurtherChanges) {
    const testing::Settled motion = testing::free_motion(1.5, 50);
    DisturbedMap map(motion.oscillator, {}, white(0.2));
    RandomNumbers random(9);
    DisturbedState disturbed{motion.point};
    while (disturbed.changes < map.changes_per_cycle()) ASSERT_TRUE(map.advance(disturbed, random));
    const auto predicted = map.at_next_phase_0(disturbed);
    ASSERT_TRUE(map.advance(disturbed, random));  // no change is left in the cycle
    EXPECT_TRUE(disturbed.at_phase_0());
    EXPECT_EQ(predicted.value(), disturbed.state);
}

}  // namespace
}  // namespace peterka::noise
