// The gaps at which a job requests the places of curves, as coordinates on the gap axis of its plane.
#pragma once

#include <cstddef>
#include <vector>

#include "curves/rig.hpp"
#include "job/job.hpp"

namespace peterka::curves {

// 0 if the gap varies along the columns; 1 if along the rows, or if neither axis is the gap.
[[nodiscard]] std::size_t gap_axis(const job::Job& job);

// Coordinates, in the job's order.
[[nodiscard]] std::vector<double> asked_gaps(const Rig& rig, const job::Job& job);

}  // namespace peterka::curves
