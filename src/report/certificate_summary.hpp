// How much of a map is proved in interval arithmetic, and why the rest isn't.
#pragma once

#include <string>

#include "findings/statistics.hpp"
#include "scene/scene.hpp"

namespace peterka {

// "" where the job asks for no certificates.
[[nodiscard]] std::string certificate_summary(const scene::Scene& scene,
                                              const findings::Statistics& statistics);

}  // namespace peterka
