// What a run of curves says at its end.
#pragma once

#include <string>

#include "curves/search.hpp"
#include "scene/scene.hpp"

namespace peterka::curves {

[[nodiscard]] std::string in_words(const scene::Scene& scene, const CurveSearchResult& found);

// How many points a rank traces in a second, and how well they obey their equations; empty without any.
[[nodiscard]] std::string speed_in_words(const CurveSearchResult& found);

}  // namespace peterka::curves
