// What a certificate changes of a cell: its label no longer depends on rounding where the start is proved to
// lead there.
#include <gtest/gtest.h>

#include <cmath>

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

// Its first cell is at this place.
job::Job job_in_many_digits(double frequency_ratio, double gap_ratio) {
    job::Job job = job_with_proofs(true);
    job.columns = {frequency_ratio, frequency_ratio + 0.1, 2, job::Spacing::linear};
    job.rows = {gap_ratio, gap_ratio + 0.1, 2, job::Spacing::linear};
    job.certificate.many_digits = true;
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

// Both motions exist in this cell; its start leads to 2/3, and rounding led a search to no impact.
TEST(CertifyCell, AResultIsReplacedOnlyByOneToWhichTheStartIsProvedToLead) {
    const job::Job job = job_in_many_digits(2.057894736842105, 1.5789473684210527);
    cell::CellResult result = testing::solved_at(2.057894736842105, 1.5789473684210527).cell;
    ASSERT_EQ(result.regime, cell::Regime::no_impact);
    result.status = cell::Status::rounding;
    const auto settled = certify_cell(job, 0, 0, result);
    ASSERT_TRUE(settled.has_value());
    EXPECT_EQ(result.status, cell::Status::rounding);

    const scene::Cell cell = scene::Scene(job).cell(0, 0);
    const auto from = [&](const scene::State<double>& start) {
        return regime::find_steady_state(cell.oscillator, start, {}, {});
    };
    const cell::CellResult found = from(start_of_search(cell, *settled));
    cell::CellResult there = found;
    ASSERT_TRUE(replaces(job, 0, 0, *settled, result, there));
    EXPECT_EQ(there.impacts, 2);
    EXPECT_EQ(there.period, 3);
    EXPECT_EQ(there.certified, cell::Certified::start);
    EXPECT_EQ(there.sensitivity, result.sensitivity);
    EXPECT_EQ(there.cycles, result.cycles + found.cycles);
    EXPECT_EQ(there.last_impact, cell::goes_on);

    cell::CellResult same = result;
    EXPECT_FALSE(replaces(job, 0, 0, *settled, result, same)) << "the same motion";
    cell::CellResult free = result;
    EXPECT_FALSE(replaces(job, 0, 0, *settled, found, free)) << "the start does not lead there";
}

// The search, led by rounding, had its last impact in another cycle.
TEST(CertifyCell, TheLastImpactIsThatOfTheProvedWay) {
    const job::Job job = job_in_many_digits(3.994736842105263, 1.1578947368421053);
    cell::CellResult result = testing::solved_at(3.994736842105263, 1.1578947368421053).cell;
    result.status = cell::Status::rounding;
    EXPECT_LT(result.last_impact, 1000);
    certify_cell(job, 0, 0, result);
    EXPECT_EQ(result.status, cell::Status::verified);
    EXPECT_EQ(result.last_impact, 1932);
}

cell::CellAttractor attractor_of(const cell::CellResult& motion) {
    return {.regime = motion.regime,
            .impacts = motion.impacts,
            .period = motion.period,
            .orbit_displacement = motion.orbit_displacement,
            .orbit_velocity = motion.orbit_velocity,
            .certified = cell::Certified::not_tried};
}

// The bounds of an attractor are those of a cell that ends on it, and no start is proved to lead there.
TEST(CertifyCell, AnAttractorHasTheCertificateOfItsOrbit) {
    job::Job job = job_with_proofs(true);
    job.starts.count = 4;
    cell::CellResult result = testing::solved_at(2.0, 0.5).cell;
    cell::CellAttractor attractor = attractor_of(result);
    certify_attractor(job, 0, 0, attractor);
    EXPECT_EQ(attractor.certified, cell::Certified::not_tried) << "not asked for";

    job.certificate.attractors = true;
    certify_attractor(job, 0, 0, attractor);
    certify_cell(job, 0, 0, result);
    EXPECT_EQ(result.certified, cell::Certified::start);
    EXPECT_EQ(attractor.certified, cell::Certified::orbit);
    EXPECT_EQ(attractor.force_lower, result.force_lower);
    EXPECT_EQ(attractor.force_upper, result.force_upper);
    EXPECT_EQ(attractor.stability_margin, result.stability_margin);

    cell::CellAttractor false_claim = attractor_of(result);
    false_claim.impacts += 1;
    certify_attractor(job, 0, 0, false_claim);
    EXPECT_EQ(false_claim.certified, cell::Certified::other_label);
    EXPECT_TRUE(std::isnan(false_claim.force_upper));
}

}  // namespace
}  // namespace peterka
