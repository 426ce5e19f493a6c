// The nondimensional numbers of a rig and its cells, from numbers in SI whose ratios are round.
#include "scene/scene.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "rig.hpp"

namespace peterka::scene {
namespace {

// omega = 5/s and k = 50 N/m; m omega = 10 kg/s, A0 omega = 0.1 m/s, k A0 = 1 N.
job::Job round_job() {
    job::Job job;
    job.hammer.mass_kg = 2;
    job.hammer.natural_frequency_hz = 5 / (2 * std::numbers::pi);
    job.hammer.damping_ns_per_m = 1;
    job.hammer.cubic_stiffness_n_per_m3 = 25000;
    job.cart.amplitude_m = 0.02;
    job.contact = job::KelvinVoigt{2000, 40};
    job.columns = {0.5, 2.5, 3};
    job.rows = {-1, 3, 5};
    return job;
}

TEST(Scene, HasTheScalesOfItsRig) {
    const Scales scales = scales_of(round_job());
    EXPECT_DOUBLE_EQ(scales.length_m, 0.02);
    EXPECT_DOUBLE_EQ(scales.frequency_rad_per_s, 5);
    EXPECT_DOUBLE_EQ(scales.force_n, 1);
    EXPECT_DOUBLE_EQ(scales.weight_n, 2 * 9.80665);
    EXPECT_DOUBLE_EQ(scales.force_ratio(), 1 / (2 * 9.80665));
}

TEST(Scene, WritesNumbersInTheUnitsOfTheFile) {
    const Scales scales{.length_m = 2, .frequency_rad_per_s = 4, .force_n = 3, .weight_n = 12};
    using enum cell::Dimension;
    EXPECT_EQ(scales.in_unit_of_file(10, label), 10);
    EXPECT_EQ(scales.in_unit_of_file(10, number), 10);
    EXPECT_EQ(scales.in_unit_of_file(10, speed_of_file), 10);
    EXPECT_EQ(scales.in_unit_of_file(10, force_over_weight), 2.5);
    EXPECT_EQ(scales.in_unit_of_file(10, speed), 80);
    EXPECT_EQ(scales.in_unit_of_file(10, impulse), 7.5);
    EXPECT_EQ(scales.in_unit_of_file(10, time), 2.5);
    EXPECT_EQ(scales.in_unit_of_file(10, power), 240);
    EXPECT_EQ(scales.in_unit_of_file(10, length), 20);
}

TEST(Scene, HasTheNumbersOfItsEquation) {
    job::Job job = round_job();
    const Oscillator<double> oscillator = oscillator_of(job);
    EXPECT_DOUBLE_EQ(oscillator.damping_ratio, 0.05);
    EXPECT_DOUBLE_EQ(oscillator.cubic, 0.2);
    EXPECT_DOUBLE_EQ(oscillator.kelvin_voigt().stiffness, 40);
    EXPECT_DOUBLE_EQ(oscillator.kelvin_voigt().damping, 4);
    job.contact = job::Restitution{.coefficient = 0.7};
    EXPECT_EQ(oscillator_of(job).restitution().coefficient, 0.7);
    job.contact = job::HuntCrossley{.stiffness_n_per_m_pow_n = 5000, .exponent = 2, .dissipation_s_per_m = 3};
    const auto law = std::get<HuntCrossley<double>>(oscillator_of(job).contact);
    EXPECT_DOUBLE_EQ(law.stiffness, 2);
    EXPECT_EQ(law.exponent, 2);
    EXPECT_DOUBLE_EQ(law.dissipation, 0.3);
}

// The hammer starts at x and x', seen from the stop at forcing phase 0, where y = 0 and y' = A0 Omega.
TEST(Scene, HasTheCellsOfItsAxes) {
    job::Job job = round_job();
    job.start.displacement_ratio = 0.25;
    job.start.velocity_ratio = 0.75;
    const Scene scene(job);
    EXPECT_EQ(scene.rows(), 5);
    EXPECT_EQ(scene.columns(), 3);
    EXPECT_FALSE(scene.rigs_differ());
    const Cell cell = scene.cell(4, 1);
    EXPECT_DOUBLE_EQ(cell.oscillator.frequency, 1.5);
    EXPECT_DOUBLE_EQ(cell.oscillator.gap, 3);
    EXPECT_DOUBLE_EQ(cell.start[0], 0.25 - 3);
    EXPECT_DOUBLE_EQ(cell.start[1], 0.75 - 1.5);
    EXPECT_DOUBLE_EQ(cell.oscillator.kelvin_voigt().stiffness, 40);
    EXPECT_EQ(cell.scales.length_m, 0.02);
}

TEST(Scene, TellsRigsApart) {
    const Oscillator<double> one = oscillator_of(round_job());
    Oscillator<double> other = one;
    other.frequency = 3;
    other.gap = 2;
    EXPECT_TRUE(same_rig(one, other));
    const auto differs = [&](auto change) {
        Oscillator<double> changed = one;
        change(changed);
        return !same_rig(one, changed) && !same_rig(changed, one);
    };
    EXPECT_TRUE(differs([](auto& rig) { rig.damping_ratio = 0.06; }));
    EXPECT_TRUE(differs([](auto& rig) { rig.cubic = 0; }));
    EXPECT_TRUE(differs([](auto& rig) { rig.cubic_form = job::CubicForm::absolute; }));
    EXPECT_TRUE(differs([](auto& rig) { rig.kelvin_voigt().stiffness = 41; }));
    EXPECT_TRUE(differs([](auto& rig) { rig.kelvin_voigt().damping = 5; }));
    EXPECT_TRUE(differs([](auto& rig) { rig.contact = Restitution<double>{40}; }));
}

TEST(ContactLaw, KnowsWhatItLosesAndWhereItLetsGo) {
    EXPECT_TRUE(is_lossless<double>(KelvinVoigt<double>{40, 0}));
    EXPECT_FALSE(is_lossless<double>(KelvinVoigt<double>{40, 4}));
    EXPECT_TRUE(is_lossless<double>(Restitution<double>{1}));
    EXPECT_FALSE(is_lossless<double>(Restitution<double>{0.9}));
    EXPECT_TRUE(is_lossless<double>(HuntCrossley<double>{2, 1.5, 0}));
    EXPECT_FALSE(is_lossless<double>(HuntCrossley<double>{2, 1.5, 0.3}));
    EXPECT_TRUE((KelvinVoigt<double>{40, 0}.lets_go_at_surface()));
    EXPECT_FALSE((KelvinVoigt<double>{40, 4}.lets_go_at_surface()));
    double position = 7;
    double velocity = -3;
    KelvinVoigt<double>{40, 4}.move_to_release(position, velocity);
    EXPECT_NEAR(40 * position + 4 * velocity, 0, 1e-14);
    HuntCrossley<double>{2, 1.5, 0.25}.move_to_release(position, velocity);
    EXPECT_EQ(velocity, -4);
    EXPECT_TRUE(is_rigid<double>(Restitution<double>{1}));
    EXPECT_FALSE(is_rigid<double>(KelvinVoigt<double>{}));
    EXPECT_FALSE(has_smooth_force<double>(HuntCrossley<double>{}));
    EXPECT_TRUE(has_closed_form<double>(KelvinVoigt<double>{}));
    EXPECT_FALSE(has_closed_form<double>(HuntCrossley<double>{}));
}

TEST(Oscillator, HasThePeriodOfTheCartOrItsOwn) {
    const Oscillator<double> driven{.frequency = 4};
    EXPECT_DOUBLE_EQ(driven.period(), std::numbers::pi / 2);
    EXPECT_EQ(driven.drive(), 16);
    EXPECT_EQ(driven.cart_reach(), 1);
    const Oscillator<double> at_rest{};
    EXPECT_DOUBLE_EQ(at_rest.period(), 2 * std::numbers::pi);
    EXPECT_EQ(at_rest.cart_reach(), 0);
    EXPECT_EQ(without_cubic(Oscillator<double>{.cubic = 3}).cubic, 0);
}

}  // namespace
}  // namespace peterka::scene
