// The values of an axis: evenly spaced, or evenly spaced in the logarithm, both ends included.
//
// The linear grid follows numpy.linspace, so that a reader of the map can reproduce it: from + i step with step
// = (to - from)/(points - 1), and the last value exactly `to`. The logarithmic axis is the exp of such a grid
// between log(from) and log(to), both ends exact.
#pragma once

#include <cstdint>
#include <vector>

#include "job/job.hpp"

namespace peterka::job {

[[nodiscard]] double axis_value(const Axis& axis, std::int64_t i);  // 0 <= i < axis.points
[[nodiscard]] std::vector<double> axis_values(const Axis& axis);

// Whether neighbouring values are far enough apart to be distinct in double precision.
[[nodiscard]] bool resolves_its_points(const Axis& axis);

}  // namespace peterka::job
