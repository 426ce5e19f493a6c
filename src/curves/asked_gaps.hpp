// The gaps at which a job asks for the places of curves, on the axis of its plane that runs over the gap.
#pragma once

#include <cstddef>
#include <vector>

#include "curves/rig.hpp"
#include "job/job.hpp"

namespace peterka::curves {

// 0 where the gap runs along the columns; 1 along the rows, or where no axis runs over it.
[[nodiscard]] std::size_t gap_axis(const job::Job& job);

// Coordinates, in the order of the job.
[[nodiscard]] std::vector<double> asked_gaps(const Rig& rig, const job::Job& job);

}  // namespace peterka::curves
