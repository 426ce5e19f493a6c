// What it takes to distinguish chaos from a long transient if max_cycles is too small.
#pragma once

#include <string>

#include "findings/statistics.hpp"
#include "scene/scene.hpp"

namespace peterka {

// The value of max_cycles that chaotic_so_far cells require, and its cost; "" if there are none.
[[nodiscard]] std::string long_chaos_in_words(const scene::Scene& scene,
                                              const findings::Statistics& statistics);

}  // namespace peterka
