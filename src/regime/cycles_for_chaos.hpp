// The largest number of cycles for which chaos is followed before it is called so (regime/chaos_claim.hpp), as
// far as an oscillator's parameters tell: the less it loses in a cycle, the longer.
#pragma once

#include <cstdint>

#include "job/job.hpp"
#include "scene/oscillator.hpp"

namespace peterka::regime {

// -ln |det J| of a cycle with this many impacts: the loss to the hammer's damping at all times, and to the stop
// while it presses, on a hammer that flies against it with nothing else acting (within 5 % where chaos of the
// paper's rig was followed). Hunt and Crossley's stop, which takes less the slower the hammer is, counts as
// lossless.
[[nodiscard]] double loss_of_a_cycle(const scene::Oscillator<double>& oscillator, double impacts);

// The max_cycles at which chaos with this many impacts is not left as chaotic_so_far; rounded up to two digits.
[[nodiscard]] std::int64_t cycles_for_chaos(const scene::Oscillator<double>& oscillator,
                                            const job::SteadyState& budget, double impacts);

}  // namespace peterka::regime
