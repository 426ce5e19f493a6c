// What a certificate changes of a cell: its label no longer depends on rounding where the start is proved to
// lead there.
#include <gtest/gtest.h>

#include "certified_cells.hpp"
#include "run/certify_cell.hpp"

namespace peterka {
namespace {

job::Job job_with_proofs(bool starts) {
    job::Job job = testing::job_170mm(0);
    job.kind = job::Kind::map;
    job.columns = {2.0, 2.1, 2, job::Spacing::linear};
    job.rows = {0.5, 0.6, 2, job::Spacing::linear};
    job.certificate = {job::every_cell, starts};
    return job;
}

TEST(CertifyCell, AProvedStartTakesRoundingFromTheStatusAndNothingElse) {
    const cell::CellResult solved = testing::solved_at(2.0, 0.5).cell;
    ASSERT_EQ(solved.regime, cell::Regime::periodic);
    const auto certified = [&](bool starts, cell::Status status, double force_times) {
        cell::CellResult result = solved;
        result.status = status;
        result.peak_force *= force_times;
        certify_cell(job_with_proofs(starts), 0, 0, result);
        EXPECT_EQ(result.certified, starts ? cell::Certified::start : cell::Certified::orbit);
        return result.status;
    };
    using enum cell::Status;
    EXPECT_EQ(certified(true, rounding, 1), verified);
    EXPECT_EQ(certified(true, rounding, 1.01), imprecise);
    EXPECT_EQ(certified(true, rounding, 0.99), imprecise);
    EXPECT_EQ(certified(true, imprecise, 1), imprecise);
    EXPECT_EQ(certified(false, rounding, 1), rounding);
}

}  // namespace
}  // namespace peterka
