// The batched engine on the orbits of all cells of a study at once, as in the computation of a map.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "study/method.hpp"

namespace peterka::study {

struct OrbitStart {
    Oscillator<double> oscillator;  // of one rig: all have the same damping and stop, and no cubic spring
    State<double> point = State<double>::Zero();
    std::size_t period = 1;  // forcing cycles
};

struct BatchTrial {
    double seconds_per_cycle = 0;                  // of one cell
    std::vector<std::vector<Observation>> orbits;  // of each cell: one period, after the timed cycles
};

// Follows copies of all cells, shuffled, about 1000 together, for `cycles` cycles, with state, Jacobian,
// contacts and forces; the time is that of the fastest repeat. The engine doesn't report impact times:
// last_touch is NaN.
[[nodiscard]] BatchTrial follow_in_batch(std::span<const OrbitStart> cells, std::int64_t cycles,
                                         std::int64_t repeats);

}  // namespace peterka::study
