// The proof that a curve has a requested gap where it was found to (certificate/branch_crossing.hpp).
#pragma once

#include <optional>

#include "curves/trace_curve.hpp"
#include "job/job.hpp"

namespace peterka::curves {

// A crossing as a guess for its proof: at the gap of the job's list nearest to it, exactly, while the number of
// the other axis is lambda.
struct CrossingGuess {
    job::CellNumbers numbers;
    certificate::BranchCrossing crossing;
};
// nothing: there is no theorem for this stop.
[[nodiscard]] std::optional<CrossingGuess> guess_of(const job::Job& job, const Rig& rig, CurveKind kind,
                                                    const Crossing& crossing);

[[nodiscard]] certificate::CrossingProof proof_of(const job::Job& job, const Rig& rig, CurveKind kind,
                                                  const Crossing& crossing);

}  // namespace peterka::curves
