// For how many cycles chaos is followed at most until it is called so (regime/chaos_claim.hpp), as far as the
// numbers of an oscillator tell: the less it loses in a cycle, the longer.
#pragma once

#include <cstdint>

#include "job/job.hpp"
#include "scene/oscillator.hpp"

namespace peterka::regime {

// -ln |det J| of a cycle with so many impacts: what the hammer's damping takes all the time, and the stop while
// it presses, on a hammer that flies against it with nothing else acting (where chaos of the paper's rig
// was followed, within 5 %). Of Hunt and Crossley's stop, which
// takes the less the slower the hammer is, nothing counts.
[[nodiscard]] double loss_of_a_cycle(const scene::Oscillator<double>& oscillator, double impacts);

// max_cycles with which chaos that strikes so often is not left as chaotic_so_far; rounded up to two digits.
[[nodiscard]] std::int64_t cycles_for_chaos(const scene::Oscillator<double>& oscillator,
                                            const job::SteadyState& budget, double impacts);

}  // namespace peterka::regime
