// How long settled motions last under the disturbances of [noise], in words.
#pragma once

#include <string>

#include "findings/life_findings.hpp"
#include "scene/scene.hpp"

namespace peterka {

// Empty if the job has no noise.
[[nodiscard]] std::string lives_summary(const scene::Scene& scene, const findings::LifeFindings& lives);

}  // namespace peterka
