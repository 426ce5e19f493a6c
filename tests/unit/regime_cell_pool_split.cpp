// Cells with a split cubic spring, solved side by side and one by one.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "regime/cell_pool.hpp"
#include "regime/solve_cell.hpp"

namespace peterka::regime {
namespace {

job::Job split_job(double cubic_stiffness) {
    job::Job job;
    job.hammer.mass_kg = 0.298;
    job.hammer.natural_frequency_hz = 4.5;
    job.hammer.damping_ns_per_m = 0.06;
    job.hammer.cubic_stiffness_n_per_m3 = cubic_stiffness;
    job.cart.amplitude_m = 0.89e-3;
    job.contact = job::KelvinVoigt{5.5e6, 1.2e3};
    job.columns = {1.6, 2.4, 5};
    job.rows = {0.0, 3.0, 4};
    job.solver.engine = job::EngineChoice::split;
    job.solver.tolerance = 1e-7;
    return job;
}

std::vector<CellResult> pooled(const scene::Scene& scene) {
    const auto columns = static_cast<std::int64_t>(scene.job().columns.points);
    const auto cells = columns * static_cast<std::int64_t>(scene.job().rows.points);
    std::vector<CellResult> results(static_cast<std::size_t>(cells));
    CellPool pool(scene, [&](const CellPool::Solved& solved) {
        results[static_cast<std::size_t>(solved.number)] = solved.result;
    });
    for (std::int64_t n = 0; n < cells; ++n) pool.add(n / columns, n % columns, n);
    while (!pool.empty()) pool.step();
    return results;
}

// The paper's cubic, stronger ones, none, and one too strong to split: every cell fails.
TEST(CellPool, SplitsTheCubicAsOneCellAloneDoes) {
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
