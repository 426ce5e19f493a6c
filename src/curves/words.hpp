// What a run of curves says at its end.
#pragma once

#include <string>

#include "curves/search.hpp"
#include "scene/scene.hpp"

namespace peterka::curves {

[[nodiscard]] std::string in_words(const scene::Scene& scene, const Findings& found);

}  // namespace peterka::curves
