// What a run of curves tells of proofs, of crossings made up by hand.
#include "curves/proof_words.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "rig.hpp"

namespace peterka::curves {
namespace {

using certificate::Crossed;

job::Job job_with_proofs() {
    job::Job job = testing::job_170mm(0);
    job.kind = job::Kind::curves;
    job.columns = {.from = 0.5, .to = 4.5, .points = 3};
    job.rows = {.from = 0, .to = 5, .points = 3};
    job.curves.gap_ratio = {1};
    job.certificate.cells = job::every_cell;
    return job;
}

Crossing crossing_at(double told, const certificate::CrossingProof& proof) {
    Crossing crossing;
    crossing.place = {told, 1};
    crossing.proof = proof;
    return crossing;
}

Crossing proved_at(double told, double low, double high) {
    return crossing_at(told, {Crossed::proved, {low, high}});
}

std::string told_of(const std::vector<Crossing>& crossings, double seconds) {
    Curve curve;
    curve.crossings = crossings;
    CurveSearchResult found;
    found.curves = {curve};
    found.proof_seconds = seconds;
    return proofs_in_words(scene::Scene(job_with_proofs()), found);
}

// Widths of 0.25, 0.5 and 1 over the larger ends 2, 2 and 4; one number lies 0.5 beside its bounds, of 4.
TEST(ProofWords, TellHowNarrowTheBoundsAre) {
    EXPECT_EQ(
        told_of({proved_at(4, 3.5, 3.5), proved_at(1.9, 1.75, 2), proved_at(2, 1.5, 2), proved_at(4, 1, 3.5)},
                0.02),
        "Proofs in interval arithmetic, of 4 places where curves have these gaps, 5.0 ms each\n"
        "  proved              4 (100.0 %), between bounds 2.5e-01 apart (median; 7.1e-01 at most), relative\n"
        "  numbers told        outside their proved bounds by 1.2e-01 at most, relative\n");
}

TEST(ProofWords, TellNoBoundsWhereNoneIsProved) {
    EXPECT_EQ(told_of({crossing_at(2, {Crossed::near_grazing})}, 0.001),
              "Proofs in interval arithmetic, of 1 places where curves have these gaps, 1.0 ms each\n"
              "  proved              0 (0.0 %)\n"
              "  not proved          1: the orbit can't be told from one with another contact (near a second "
              "grazing)\n");
}

TEST(ProofWords, SayWhereNoCurveHasTheGaps) {
    EXPECT_EQ(told_of({}, 0), "Proofs in interval arithmetic: no curve has one of these gaps\n");
}

}  // namespace
}  // namespace peterka::curves
