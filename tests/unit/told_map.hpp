// A coarse map whose cells have the motions that a test tells it.
#pragma once

#include <vector>

#include "curves/coarse_map.hpp"

namespace peterka::testing {

inline curves::CoarseMap told_map(const scene::Scene& scene, const curves::Rig& rig,
                                  const std::vector<curves::Site>& sites) {
    curves::Numbers numbers;
    for (const curves::Site& site : sites) {
        numbers.insert(numbers.end(), {1, static_cast<double>(site.regime), static_cast<double>(site.status),
                                       static_cast<double>(site.impacts), static_cast<double>(site.period),
                                       site.peak_force, site.orbit[0], site.orbit[1]});
    }
    curves::CoarseMap map(scene, rig);
    map.put_together({numbers});
    return map;
}

}  // namespace peterka::testing
