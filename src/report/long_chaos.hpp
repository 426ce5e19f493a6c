// What it takes to tell chaos from a long transient where max_cycles are too few for that.
#pragma once

#include <string>

#include "findings/statistics.hpp"
#include "scene/scene.hpp"

namespace peterka {

// The value of max_cycles that the cells ask for which are chaotic_so_far, and its price; "" where none is.
[[nodiscard]] std::string long_chaos_in_words(const scene::Scene& scene,
                                              const findings::Statistics& statistics);

}  // namespace peterka
