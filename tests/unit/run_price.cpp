// What `check` says a job needs: of the law and kind that it has.
#include "run/price.hpp"

#include <gtest/gtest.h>

#include <string>

#include "map_examples.hpp"

namespace peterka {
namespace {

using map_file::examples::small_map;

TEST(Price, ProofsCostNothingWhereNoneAreAskedForOrThereIsNoTheorem) {
    job::Job job = small_map(10, 20);
    EXPECT_EQ(certificate_price(job), "");
    job.certificate.cells = 30;
    EXPECT_EQ(certificate_price(job), "#   proofs   of 30 cells: 3.0 ms of one core, or less\n");
    job.certificate.cells = job::every_cell;
    EXPECT_EQ(certificate_price(job), "#   proofs   of 200 cells: 20.0 ms of one core, or less\n");
    job.certificate.starts = true;
    EXPECT_EQ(certificate_price(job), "#   proofs   of 200 cells: 340.0 ms of one core, or less\n");
    job.certificate.many_digits = true;
    EXPECT_EQ(certificate_price(job),
              "#   proofs   of 200 cells: 340.0 ms of one core, or less\n"
              "#   proofs   in many digits: some 300.0 ms of one core for each start that doubles lose\n");
    job.certificate.many_digits = false;
    job.certificate.starts = false;
    job.contact = job::Restitution{.coefficient = 0.5};
    EXPECT_EQ(certificate_price(job), "#   proofs   of 200 cells: 20.0 ms of one core, or less\n");
    job.contact =
        job::HuntCrossley{.stiffness_n_per_m_pow_n = 1e8, .exponent = 1.5, .dissipation_s_per_m = 0.1};
    EXPECT_NE(certificate_price(job).find("proofs   none"), std::string::npos) << certificate_price(job);
}

TEST(Price, MemoryGrowsWithStartsUntilARoundIsFull) {
    const auto bytes = [](std::int64_t starts) {
        job::Job job = small_map(100, 100);
        job.starts.count = starts;
        return static_cast<double>(memory_per_rank(job));
    };
    // 1 kB for each result of a round, a fifth of the starts but 8 at least and 256 at most, in 800 cells
    const double one = 800 * 1000.0;
    EXPECT_NEAR(bytes(100) - bytes(10), 12 * one, one);
    EXPECT_NEAR(bytes(2000) - bytes(100), 236 * one, 5 * one);
    EXPECT_NEAR(bytes(2000), bytes(4000), 5 * one);
}

// Of each point, branch and attractor, with as many samples of its motion as are asked for.
TEST(Price, MemoryOfASweepGrowsInProportionToItsSamples) {
    const auto bytes = [](std::int64_t samples) {
        job::Job job = small_map(1, 1000);
        job.kind = job::Kind::sweep;
        job.sweep = {.gap_ratio = {1.0}, .direction = job::Direction::up};
        job.sweep.samples = samples;
        job.starts.count = 20;
        return static_cast<double>(memory_per_rank(job));
    };
    const double first = bytes(200) - bytes(100);
    const double second = bytes(400) - bytes(200);
    // four numbers of 8 bytes, 1000 points, and each of the attractors kept
    EXPECT_GT(first, 100 * 4 * 8 * 1000.0 * static_cast<double>(job::Starts{}.attractors));
    EXPECT_NEAR(second / first, 2, 0.1);
}

// Cycles of a sweep by an integrator are timed by themselves.
TEST(Price, ASweepByAnIntegratorHasATime) {
    job::Job job = small_map(1, 6);
    job.kind = job::Kind::sweep;
    job.sweep = {.gap_ratio = {1.0}, .direction = job::Direction::up};
    job.solver.engine = job::EngineChoice::cvode;
    const std::string text = time_price(job);
    EXPECT_EQ(text.find("unknown"), std::string::npos) << text;
    EXPECT_EQ(text.find("nan"), std::string::npos) << text;
}

TEST(Price, WhereNothingDissipatesNoNumberOfCyclesIsAdvised) {
    job::Job job = small_map(10, 20);
    job.contact = job::Restitution{.coefficient = 1};
    EXPECT_EQ(long_chaos_price(job).find("nothing dissipates"), std::string::npos) << long_chaos_price(job);
    job.hammer.damping_ratio = 0;
    job.hammer.damping_ns_per_m.reset();
    const std::string told = long_chaos_price(job);
    EXPECT_NE(told.find("nothing dissipates"), std::string::npos) << told;
    EXPECT_EQ(told.find("With max_cycles"), std::string::npos) << told;
}

}  // namespace
}  // namespace peterka
