// What is sound in a job and unlikely to be meant: told by `check` and by `run`, and no fault.
#pragma once

#include <string>
#include <vector>

#include "job/job.hpp"

namespace peterka::job {

// One sentence each. Lengths that look like millimetres given as metres: a gap or a start beyond a hundred
// amplitudes of the cart, or an amplitude of a decimetre or more. Numbers other than those of which a
// covariance was identified, and uncertain numbers of which no rig is drawn.
[[nodiscard]] std::vector<std::string> remarks(const Job& job);

}  // namespace peterka::job
