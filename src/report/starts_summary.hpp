// What many starts in each cell show about a map.
#pragma once

#include <string>

#include "findings/start_findings.hpp"
#include "scene/scene.hpp"

namespace peterka {

// "" where the job has no [starts].
[[nodiscard]] std::string starts_summary(const scene::Scene& scene, const findings::StartFindings& findings);

}  // namespace peterka
