// The closing summary of a run of curves.
#pragma once

#include <string>

#include "curves/search.hpp"
#include "scene/scene.hpp"

namespace peterka::curves {

[[nodiscard]] std::string in_words(const scene::Scene& scene, const CurveSearchResult& found);

// Points traced per second and rank, and their median residual; empty if there are none.
[[nodiscard]] std::string speed_in_words(const CurveSearchResult& found);

}  // namespace peterka::curves
