// Sweeps over a parameter of the rig: the motion is handed on in metres and metres per second.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "regime/branch.hpp"
#include "rig.hpp"

namespace peterka::regime {
namespace {

struct OfTheRig {
    double amplitude_m;
    double natural_frequency_hz;
    [[nodiscard]] double speed_m_per_s() const {
        return amplitude_m * 2 * std::numbers::pi * natural_frequency_hz;
    }
};

// Three cycles prove nothing, so the force at the second point depends on where the first one left the hammer.
void expect_handed_on_in_si(const std::string& key, double from, double to, const OfTheRig& first,
                            const OfTheRig& second, double gap_ratio) {
    job::Job job = testing::job_170mm(0);
    job.kind = job::Kind::sweep;
    job.columns = {.from = from, .to = to, .points = 2, .over = key};
    job.contact = job::KelvinVoigt{5.5e6, 20};  // little dissipation, so that three cycles keep the memory
    job.operating_point = {2, gap_ratio};
    job.sweep = {.gap_ratio = {}, .direction = job::Direction::up};
    job.steady_state.max_cycles = 3;
    const scene::Scene scene(job);
    const auto points = follow_branch(scene, 0, [] {});
    ASSERT_EQ(points.size(), 2U);
    ASSERT_EQ(points[0].cell.regime, Regime::unresolved);
    ASSERT_TRUE(points[0].motion.end.has_value());

    const scene::State<double> end = *points[0].motion.end;  // (delta, delta')
    const double frequency = 2;                              // of the cart, over each hammer's own
    const double place_m = (end[0] + gap_ratio) * first.amplitude_m;
    const double velocity_m_per_s = (end[1] + frequency) * first.speed_m_per_s();
    scene::Cell by_hand = scene.cell(0, 1);
    ASSERT_EQ(by_hand.oscillator.frequency, frequency);
    ASSERT_LT(end[0], 0);  // in flight, so that it stays there
    by_hand.start = {std::min(place_m / second.amplitude_m - gap_ratio, 0.0),
                     velocity_m_per_s / second.speed_m_per_s() - frequency};
    const CellResult right = find_steady_state(by_hand.oscillator, by_hand.start, job.steady_state);
    EXPECT_NEAR(points[1].cell.peak_force / right.peak_force, 1, 1e-9);
    // without rescaling, the same numbers lead elsewhere
    const CellResult wrong = find_steady_state(by_hand.oscillator, end, job.steady_state);
    EXPECT_GT(std::abs(wrong.peak_force / right.peak_force - 1), 1e-3);
}

TEST(BranchOfRigs, HandsOnLengthsWhereTheCartsAmplitudeChanges) {
    expect_handed_on_in_si("cart.amplitude_m", 0.9e-3, 1.3e-3, {0.9e-3, 4.5}, {1.3e-3, 4.5}, 0.5);
}

TEST(BranchOfRigs, HandsOnSpeedsWhereTheHammersFrequencyChanges) {
    expect_handed_on_in_si("hammer.natural_frequency_hz", 4.5, 6.5, {0.89e-3, 4.5}, {0.89e-3, 6.5}, 0.5);
}

}  // namespace
}  // namespace peterka::regime
