// The borders of each regime at the gaps that a job names, as text.
#pragma once

#include <string>

#include "curves/search.hpp"
#include "scene/scene.hpp"

namespace peterka::curves {

// For regimes with more than 1 % of the coarse map; empty if the job names no gap.
[[nodiscard]] std::string borders_in_words(const scene::Scene& scene, const CurveSearchResult& found);

}  // namespace peterka::curves
