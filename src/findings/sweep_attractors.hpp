// What starts find along a sweep beside the motions that its branches are on. Of one gap.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "findings/sweep_findings.hpp"
#include "quantities/fields.hpp"

namespace peterka {

// Attractors of one class on which no branch is, at whatever points.
struct Unvisited {
    MotionClass motion;
    std::int64_t points = 0;
    std::int64_t first = 0;  // columns
    std::int64_t last = 0;
    double largest_share = 0;      // of the starts of a point
    bool beside_its_like = false;  // somewhere a branch is on another attractor of this class
};

struct GapAttractors {
    std::int64_t points = 0;
    std::int64_t several = 0;               // points with more attractors than one
    std::int64_t most = 0;                  // at one point
    std::int64_t with_unvisited = 0;        // points with one on which no branch is
    std::vector<Unvisited> unvisited = {};  // those at most points first
};

// cells: of all branches with this gap, row after row; attractors: slot after slot, row after row, as many of
// each cell as are kept.
[[nodiscard]] GapAttractors find_beside_branches(std::span<const quantities::StoredCell> cells,
                                                 std::span<const quantities::StoredAttractor> attractors,
                                                 std::int64_t columns);

}  // namespace peterka
