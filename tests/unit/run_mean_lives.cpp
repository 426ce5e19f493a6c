#include "run/mean_lives.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "rig.hpp"

namespace peterka {
namespace {

// Two cells of the same place, where 1/3 has a narrow basin: its lives are short.
job::Job disturbed(double cubic) {
    job::Job job = testing::job_170mm(cubic);
    job.kind = job::Kind::map;
    job.columns = {0.9, 0.9 + 1e-9, 2};
    job.rows = {3, 3, 1};
    job.noise.acceleration_m_s2_per_sqrt_hz =
        0.03 * std::sqrt(2 * 28.2743) * 0.89e-3 * 28.2743;  // 0.03 A0 omega
    job.noise.cycles = 20'000;
    return job;
}

cell::CellResult one_in_three(const scene::Scene& scene) {
    const scene::Cell cell = scene.cell(0, 0);
    regime::CellResult found;
    for (int n = 0; n < 40; ++n) {  // of some starts one ends there
        found = regime::find_steady_state(cell.oscillator, {-2.0288 - 3 + 0.01 * n, 2.9446}, {});
        if (found.period == 3) break;
    }
    EXPECT_EQ(found.period, 3);
    return found;
}

double cycles_of(const scene::Scene& scene, double life) {
    return life / scene.cell(0, 0).oscillator.period();
}

TEST(MeanLives, ASettledMotionHasOneAndChaosHasNone) {
    const scene::Scene scene(disturbed(0));
    cell::CellResult motion = one_in_three(scene);
    add_mean_life(scene, 0, 0, motion);
    EXPECT_NEAR(cycles_of(scene, motion.mean_life), 13.5, 5.5);  // 13.5 +- 0.3 of longer runs
    EXPECT_GT(motion.mean_life_error, 0);
    EXPECT_TRUE(std::isnan(motion.mean_life_least));
    for (const auto regime : {cell::Regime::chaotic, cell::Regime::unresolved, cell::Regime::failed}) {
        cell::CellResult other = motion;
        other.mean_life = cell::unknown;
        other.regime = regime;
        add_mean_life(scene, 0, 0, other);
        EXPECT_TRUE(std::isnan(other.mean_life));
    }
}

TEST(MeanLives, DisturbancesAreThoseOfTheCellAndTheMotionAlone) {
    const scene::Scene scene(disturbed(0));
    cell::CellResult motion = one_in_three(scene);
    cell::CellResult again = motion;
    cell::CellResult elsewhere = motion;
    add_mean_life(scene, 0, 0, motion);
    add_mean_life(scene, 0, 0, again);
    add_mean_life(scene, 0, 1, elsewhere);
    EXPECT_EQ(motion.mean_life, again.mean_life);
    EXPECT_NE(motion.mean_life, elsewhere.mean_life);
    cell::CellAttractor attractor;
    attractor.regime = motion.regime;
    attractor.period = motion.period;
    attractor.orbit_displacement = motion.orbit_displacement;
    attractor.orbit_velocity = motion.orbit_velocity;
    add_mean_life(scene, 0, 0, attractor);
    EXPECT_EQ(attractor.mean_life, motion.mean_life);
}

TEST(MeanLives, AShareOfTheCyclesIsAsMany) {
    job::Job half = disturbed(0);
    half.noise.cycles /= 2;
    const scene::Scene scene(disturbed(0));
    const scene::Scene scene_of_half(half);
    cell::CellResult all = one_in_three(scene);
    cell::CellResult share = all;
    cell::CellResult fewer = all;
    add_mean_life(scene, 0, 0, all);
    add_mean_life(scene, 0, 0, share, 0.5);
    add_mean_life(scene_of_half, 0, 0, fewer);
    EXPECT_EQ(share.mean_life, fewer.mean_life);
    EXPECT_EQ(share.mean_life_error, fewer.mean_life_error);
    EXPECT_NE(share.mean_life, all.mean_life);
}

TEST(MeanLives, WithStartsTheyAreThoseOfTheAttractors) {
    job::Job job = disturbed(0);
    job.starts.count = 8;
    const scene::Scene scene(job);
    cell::CellResult motion = one_in_three(scene);
    add_mean_life(scene, 0, 0, motion);
    EXPECT_TRUE(std::isnan(motion.mean_life));
}

// With springs whose cubic term bends the orbit: the map without it doesn't return to its point.
TEST(MeanLives, AMotionIsFollowedWithTheSpringsThatItWasFoundWith) {
    const scene::Scene linear(disturbed(0));
    const scene::Scene weak(disturbed(238.2));
    cell::CellResult motion = one_in_three(linear);
    cell::CellResult left_out = motion;
    add_mean_life(linear, 0, 0, motion);
    add_mean_life(weak, 0, 0, left_out);
    EXPECT_EQ(left_out.mean_life, motion.mean_life);
    const scene::Scene strong(disturbed(238.2e3));
    cell::CellResult of_other_springs = one_in_three(linear);
    add_mean_life(strong, 0, 0, of_other_springs);
    EXPECT_EQ(of_other_springs.mean_life, motion.mean_life);
    job::Job kept = disturbed(238.2e3);
    kept.solver.engine = job::EngineChoice::split;
    cell::CellResult lost = one_in_three(linear);
    add_mean_life(scene::Scene(kept), 0, 0, lost);
    EXPECT_TRUE(std::isnan(lost.mean_life));  // it is no orbit of these springs
}

TEST(MeanLives, WithoutNoiseThereAreNone) {
    job::Job job = disturbed(0);
    const scene::Scene scene(job);
    cell::CellResult motion = one_in_three(scene);
    job.noise = {};
    add_mean_life(scene::Scene(job), 0, 0, motion);
    EXPECT_TRUE(std::isnan(motion.mean_life));
    EXPECT_TRUE(std::isnan(motion.mean_life_least));
}

}  // namespace
}  // namespace peterka
