// The proof that a curve has a requested gap where it was found to (certificate/branch_crossing.hpp).
#pragma once

#include "curves/trace_curve.hpp"
#include "job/job.hpp"

namespace peterka::curves {

// At the gap of the job's list nearest to the crossing, exactly; lambda is the number of the other axis.
[[nodiscard]] certificate::CrossingProof proof_of(const job::Job& job, const Rig& rig, CurveKind kind,
                                                  const Crossing& crossing);

}  // namespace peterka::curves
