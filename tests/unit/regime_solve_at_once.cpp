// Cells that never meet the stop are classified without a search, with the same result.
#include <gtest/gtest.h>

#include <complex>
#include <random>

#include "regime/engine.hpp"
#include "regime/lasting_motion_proof.hpp"
#include "regime/scalar_engine.hpp"
#include "regime/solve_cell.hpp"
#include "rig.hpp"
#include "same_bytes.hpp"
#include "scene/scene.hpp"

namespace peterka::regime {
namespace {

// Springs and stops of all kinds, from no cubic at all to one beyond the closed-form proof.
job::Job any_job(std::mt19937& random) {
    const auto one_of = [&](std::initializer_list<double> values) {
        return values.begin()[std::uniform_int_distribution<std::size_t>(0, values.size() - 1)(random)];
    };
    job::Job job = testing::job_170mm(one_of({0, 238.2325, 238.2325, 2e4, 1e7}));
    job.columns.points = job.rows.points = 1;
    job.hammer.damping_ns_per_m = one_of({0, 0.06, 1, 30});
    if (one_of({0, 1}) == 1) job.contact = job::Restitution{0.7};
    job.solver.omit_tolerance = one_of({1e-3, 1e-3, 0});
    job.solver.engine = one_of({0, 0, 1}) == 0 ? job::EngineChoice::automatic : job::EngineChoice::arkode;
    if (one_of({0, 1}) == 1) job.output.fields = {job::OptionalField::force_per_cycle};
    if (one_of({0, 0, 1}) == 1) job.output.fields = {job::OptionalField::impact_speed};
    job.steady_state.max_cycles = 60;
    return job;
}

scene::Cell any_cell(const job::Job& job, std::mt19937& random) {
    const auto between = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    scene::Cell cell = scene::Scene(job).cell(0, 0);
    cell.oscillator.frequency = between(1.5, 4.5);
    cell.oscillator.gap = between(0, 8);
    const bool at_rest = between(0, 1) < 0.5;
    const double displacement = at_rest ? 0 : between(-3, 3);
    cell.start = {displacement - cell.oscillator.gap,
                  (at_rest ? 0 : between(-3, 3)) - cell.oscillator.frequency};
    return cell;
}

TEST(SolveAtOnce, SaysWhatTheSearchSays) {
    std::mt19937 random(22);
    int at_once_too = 0;
    int by_search_alone = 0;
    for (int n = 0; n < 800; ++n) {
        const job::Job job = any_job(random);
        const scene::Cell cell = any_cell(job, random);
        const auto at_once = solve_at_once(job, cell);
        CycleBroker broker;
        const CellResult searched = complete(solve_cell(broker, job, cell), broker);
        if (at_once) {
            ++at_once_too;
            EXPECT_TRUE(testing::same_bytes(*at_once, searched)) << n;
        } else {
            ++by_search_alone;
            // otherwise no search would have been needed
            EXPECT_TRUE(searched.engine != Engine::exact || searched.cycles > 0) << n;
        }
    }
    EXPECT_GT(at_once_too, 100);
    EXPECT_GT(by_search_alone, 200);
}

// Without its cubic term, of an effect e on the stiffness, a free motion may touch where the gap exceeds its
// reach by less than L/3/(1 - L), L = e H (regime/lasting_motion_proof.hpp).
TEST(SolveAtOnce, LeavesTheCubicTermOutAsFarAsItBringsNoTouch) {
    job::Job job = testing::job_170mm(2e5);
    job.columns.points = job.rows.points = 1;
    job.hammer.damping_ns_per_m = 1;
    job.solver.omit_tolerance = 1;
    const scene::Cell cell = scene::Scene(job).cell(0, 0);
    const double zeta = cell.oscillator.damping_ratio;
    const std::complex<double> swing =
        9.0 / std::complex<double>(1 - 9.0, 2 * zeta * 3);  // of the settled motion
    const auto stays_free = [&](double gap) {
        scene::Cell settled = cell;
        settled.oscillator.frequency = 3;
        settled.oscillator.gap = gap;
        settled.start = {swing.imag() - gap, 3 * swing.real()};
        const auto found = solve_at_once(job, settled);
        return found && found->regime == Regime::no_impact;
    };
    const double reach = std::abs(swing);
    const double loop = effect_of_cubic(cell.oscillator, reach) * gain(zeta);
    ASSERT_GT(loop, 0.01);
    ASSERT_LT(loop, 0.9);
    const double edge = reach * (1 + loop / 3 / (1 - loop));
    EXPECT_FALSE(stays_free(edge * (1 - 1e-6)));
    EXPECT_TRUE(stays_free(edge * (1 + 1e-6)));
}

}  // namespace
}  // namespace peterka::regime
