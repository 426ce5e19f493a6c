// The inverse of the normal distribution function: algorithm AS 241 (PPND16) of M. J. Wichura, The percentage
// points of the normal distribution, Applied Statistics 37 (1988), with a relative error of 1e-16 or so.
#pragma once

namespace peterka::job {

// 0 < probability < 1.
[[nodiscard]] double normal_quantile(double probability);

}  // namespace peterka::job
