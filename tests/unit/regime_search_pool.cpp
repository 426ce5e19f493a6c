// Cells solved side by side give the same results as alone.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include "regime/search_pool.hpp"
#include "regime/solve_cell.hpp"
#include "rig.hpp"
#include "same_bytes.hpp"
#include "trajectory/exact_cycle_map.hpp"

namespace peterka::regime {
namespace {

using testing::same_bytes;

job::Job split_job(double cubic_stiffness) {
    job::Job job = testing::job_170mm(cubic_stiffness);
    job.columns = {1.6, 2.4, 5};
    job.rows = {0.0, 3.0, 4};
    job.solver.engine = job::EngineChoice::split;
    job.solver.tolerance = 1e-7;
    return job;
}

job::Job linear_job(std::int64_t columns, std::int64_t rows) {
    job::Job job = split_job(0);
    job.columns = {0.5, 4.5, columns};
    job.rows = {0.0, 5.0, rows};
    job.solver.engine = job::EngineChoice::automatic;
    return job;
}

std::vector<std::int64_t> all_cells(const scene::Scene& scene) {
    std::vector<std::int64_t> cells(static_cast<std::size_t>(scene.rows() * scene.columns()));
    std::iota(cells.begin(), cells.end(), 0);
    return cells;
}

// In the order of `cells`, added in that order.
std::vector<CellResult> pooled(const scene::Scene& scene, const std::vector<std::int64_t>& cells) {
    std::vector<CellResult> results(cells.size());
    const AttractorTable nothing_known;
    SearchPool pool(scene, nothing_known, [&](const SearchPool::NumberedOutcome& solved) {
        results[static_cast<std::size_t>(solved.number)] = solved.outcome.result;
    });
    for (std::size_t n = 0; n < cells.size(); ++n) {
        while (!pool.has_room()) pool.step();
        pool.add(cells[n] / scene.columns(), cells[n] % scene.columns(), static_cast<std::int64_t>(n));
    }
    while (!pool.empty()) pool.step();
    return results;
}

std::vector<CellResult> pooled(const scene::Scene& scene) {
    return pooled(scene, all_cells(scene));
}

std::vector<CellResult> one_by_one(const scene::Scene& scene) {
    std::vector<CellResult> results;
    for (const std::int64_t cell : all_cells(scene)) {
        results.push_back(solve_cell(scene, cell / scene.columns(), cell % scene.columns()));
    }
    return results;
}

// What the owner spends on the first cell is not charged to the others that share its batch's step.
TEST(SearchPool, WhatTheOwnerSpendsIsNotChargedToOthers) {
    const scene::Scene scene(linear_job(20, 20));
    const AttractorTable nothing_known;
    double charged = 0;
    bool first = true;
    std::optional<SearchPool> pool;
    pool.emplace(scene, nothing_known, [&](const SearchPool::NumberedOutcome& solved) {
        charged += solved.seconds;
        if (std::exchange(first, false)) return;
        pool->spent_elsewhere(1e6);
    });
    for (const std::int64_t cell : all_cells(scene)) {
        while (!pool->has_room()) pool->step();
        pool->add(cell / scene.columns(), cell % scene.columns(), cell);
    }
    while (!pool->empty()) pool->step();
    EXPECT_LT(charged, -1e6);
}

// The engines round differently. A label may depend on that where a perturbation grew by e^20 (fractal basin
// boundaries, chaos), and nowhere else.
TEST(SearchPool, LabelsAWholeMapAsTheScalarEngineDoes) {
    const scene::Scene scene(linear_job(60, 50));
    const auto together = pooled(scene);
    const auto alone = one_by_one(scene);
    int different = 0;
    int struck = 0;
    for (std::size_t n = 0; n < alone.size(); ++n) {
        const bool fractal = std::max(together[n].sensitivity, alone[n].sensitivity) > 20;
        if (!same_label(together[n], alone[n])) {
            ++different;
            EXPECT_TRUE(fractal) << n;
        } else if (alone[n].regime == Regime::no_impact && !fractal) {
            EXPECT_EQ(together[n].last_impact, alone[n].last_impact) << n;
            struck += alone[n].last_impact > 1 ? 1 : 0;
        } else if (alone[n].regime == Regime::periodic && !fractal) {
            EXPECT_NEAR(together[n].peak_force, alone[n].peak_force, 1e-9 * alone[n].peak_force) << n;
            EXPECT_NEAR(together[n].multiplier, alone[n].multiplier, 1e-6) << n;
        }
    }
    EXPECT_LT(different, 15);  // of 3000
    EXPECT_GT(struck, 100);    // end without impact after some
}

TEST(SearchPool, ACellDoesNotDependOnItsCompany) {
    const scene::Scene scene(linear_job(40, 30));
    const auto expected = pooled(scene);
    auto order = all_cells(scene);
    std::shuffle(order.begin(), order.end(), std::mt19937(3));
    order.resize(700);
    const auto others = pooled(scene, order);
    for (std::size_t n = 0; n < order.size(); ++n) {
        EXPECT_TRUE(same_bytes(others[n], expected[static_cast<std::size_t>(order[n])])) << order[n];
    }
}

// The batch records only peak forces: other quantities come from the scalar engine.
TEST(SearchPool, MeasuresImpactsToo) {
    job::Job job = linear_job(9, 7);
    job.output.fields = {job::OptionalField::impact_speed, job::OptionalField::impulse,
                         job::OptionalField::force_per_cycle};
    const scene::Scene scene(job);
    const auto together = pooled(scene);
    const auto alone = one_by_one(scene);
    int measured = 0;
    for (std::size_t n = 0; n < alone.size(); ++n) {
        if (alone[n].regime != Regime::periodic || !same_label(together[n], alone[n])) continue;
        ++measured;
        EXPECT_NEAR(together[n].impact_speed, alone[n].impact_speed, 1e-8 * alone[n].impact_speed);
        EXPECT_NEAR(together[n].impulse, alone[n].impulse, 1e-8 * alone[n].impulse);
        EXPECT_NEAR(together[n].peak_force_mean, alone[n].peak_force_mean, 1e-8 * alone[n].peak_force);
        EXPECT_EQ(together[n].window_cycles, together[n].period);
    }
    EXPECT_GT(measured, 15);
}

// A rigid stop, with and without impact measurements; a preloaded one,
// on which chatter and sticking continue across the ends of cycles.
job::Job rigid_job(double restitution, double lowest_gap) {
    job::Job job = linear_job(40, 20);
    job.rows = {lowest_gap, 2.0, 20};
    job.contact = job::Restitution{restitution};
    job.output.fields = {job::OptionalField::impact_speed, job::OptionalField::impulse,
                         job::OptionalField::contact_time, job::OptionalField::contact_power};
    return job;
}

void expect_as_alone(const scene::Scene& scene) {
    const auto together = pooled(scene);
    const auto alone = one_by_one(scene);
    int different = 0;
    int chatters = 0;
    for (std::size_t n = 0; n < alone.size(); ++n) {
        SCOPED_TRACE(n);
        const CellResult& a = together[n];
        const CellResult& b = alone[n];
        chatters += b.chatter ? 1 : 0;
        const bool fractal = std::max(a.sensitivity, b.sensitivity) > 20;
        if (!same_label(a, b) || a.chatter != b.chatter) {
            ++different;
            EXPECT_TRUE(fractal);
            continue;
        }
        if (!has_period(b.regime) || fractal) continue;
        EXPECT_NEAR(a.impact_rate, b.impact_rate, 1e-15);
        EXPECT_EQ(std::isnan(a.peak_force), std::isnan(b.peak_force));
        if (b.regime == Regime::sustained_contact) {
            EXPECT_NEAR(a.peak_force, b.peak_force, 1e-12 * b.peak_force);
        }
        EXPECT_NEAR(a.multiplier, b.multiplier, 1e-6);
        // a long orbit, superstable by sticking, amplifies rounding as much as a run that converges to it
        if (b.sensitivity > 12) continue;
        const auto expect_same = [&](double one, double other) {
            EXPECT_EQ(std::isnan(one), std::isnan(other));
            if (std::isnan(other)) return;
            EXPECT_NEAR(one, other, 1e-9 * (1 + other));
        };
        expect_same(a.impact_speed, b.impact_speed);
        expect_same(a.impulse, b.impulse);
        expect_same(a.contact_time, b.contact_time);
        expect_same(a.contact_power, b.contact_power);
    }
    EXPECT_LT(different, 16);  // of 800
    EXPECT_GT(chatters, 30);
}

TEST(SearchPool, SolvesRigidStopsAsOneCellAloneDoes) {
    expect_as_alone(scene::Scene(rigid_job(0.32, 0)));
    job::Job preloaded = rigid_job(0.2, -0.5);
    preloaded.columns = {0.4, 2.4, 40};
    preloaded.rows = {-0.5, 0.0, 20};
    preloaded.start.displacement_ratio = -4;  // outside the stop
    expect_as_alone(scene::Scene(preloaded));
    job::Job job = rigid_job(0.5, 0);
    job.output.fields.clear();
    expect_as_alone(scene::Scene(job));
}

TEST(SearchPool, OtherLawsAreServedOneAfterTheOther) {
    job::Job job = linear_job(3, 2);
    job.contact = job::HuntCrossley{5.5e8, 1.5, 1.0};
    const scene::Scene scene(job);
    const auto together = pooled(scene);
    const auto alone = one_by_one(scene);
    for (std::size_t n = 0; n < alone.size(); ++n) EXPECT_TRUE(same_bytes(together[n], alone[n])) << n;
}

// The cycles of a 2/2 orbit differ in force; those of chaos scatter.
TEST(SearchPool, ForcePerCycle) {
    job::Job job = linear_job(2, 1);
    job.output.fields = {job::OptionalField::force_per_cycle};
    job.columns = {2.7, 2.75, 2};  // gap 0: 2/2
    job.rows = {0.0, 1e-9, 1};
    const scene::Scene scene(job);
    const CellResult cell = pooled(scene)[1];
    ASSERT_EQ(cell.period, 2);
    const scene::Oscillator<double> oscillator = scene.cell(0, 1).oscillator;
    const trajectory::ExactCycleMap<double> map(oscillator);
    scene::State<double> x(cell.orbit_displacement - oscillator.gap, cell.orbit_velocity);
    std::vector<double> peaks;
    for (int n = 0; n < 2; ++n) {
        trajectory::Recorder<double> recorder;
        x = map(x, &recorder).end;
        peaks.push_back(recorder.totals().largest_force);
    }
    EXPECT_GT(std::abs(peaks[0] - peaks[1]), 1);
    EXPECT_EQ(cell.window_cycles, 2);
    EXPECT_NEAR(cell.peak_force_mean, (peaks[0] + peaks[1]) / 2, 1e-8);
    EXPECT_NEAR(cell.peak_force_q95, std::max(peaks[0], peaks[1]), 1e-8);

    job.columns = {1.2, 4.5, 60};
    job.rows = {0.0, 0.5, 2};
    int chaotic = 0;
    for (const CellResult& wild : pooled(scene::Scene(job))) {
        if (wild.regime != Regime::chaotic) continue;
        ++chaotic;
        EXPECT_GT(wild.peak_force_mean, 0);
        EXPECT_LT(wild.peak_force_mean, wild.peak_force_q95);
        EXPECT_LE(wild.peak_force_q95, wild.peak_force);
        EXPECT_GE(wild.window_cycles, 200);
    }
    EXPECT_GT(chaotic, 0);
}

// The paper's cubic, stronger ones, none, and one too strong to split: then every cell fails.
TEST(SearchPool, SplitsTheCubicAsOneCellAloneDoes) {
    for (const double stiffness : {238.2325, 5e3, 0.0, 1e10}) {
        const scene::Scene scene(split_job(stiffness));
        const auto results = pooled(scene);
        for (std::size_t n = 0; n < results.size(); ++n) {
            SCOPED_TRACE(::testing::Message() << stiffness << " cell " << n);
            const auto row = static_cast<std::int64_t>(n / 5);
            const auto column = static_cast<std::int64_t>(n % 5);
            const CellResult alone = solve_cell(scene, row, column);
            EXPECT_EQ(results[n].regime, alone.regime);
            EXPECT_EQ(results[n].regime == Regime::failed, stiffness > 1e9);
            EXPECT_EQ(results[n].impacts, alone.impacts);
            EXPECT_EQ(results[n].period, alone.period);
            EXPECT_EQ(results[n].engine, Engine::split);
            if (alone.regime == Regime::periodic) {
                EXPECT_NEAR(results[n].peak_force / alone.peak_force, 1, 1e-9);
            }
        }
    }
}

}  // namespace
}  // namespace peterka::regime
