// Attractors that are known along a sweep at one gap, besides those of its branches.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "findings/sweep_findings.hpp"
#include "quantities/fields.hpp"

namespace peterka {

// Attractors of one class that no branch is on, over all points.
struct Unvisited {
    MotionClass motion;
    std::int64_t points = 0;
    std::int64_t first = 0;  // columns
    std::int64_t last = 0;
    double largest_share = 0;      // of a point's starts; 0 where none found it
    bool beside_its_like = false;  // at some point a branch is on another attractor of this class
};

struct GapAttractors {
    std::int64_t points = 0;
    std::int64_t several = 0;               // points with more than one attractor, unresolved ones not counted
    std::int64_t most = 0;                  // attractors at one point
    std::int64_t with_unvisited = 0;        // points with an attractor that no branch is on
    std::vector<Unvisited> unvisited = {};  // by decreasing number of points
};

// cells: those of all branches at this gap, row by row; attractors: slot by slot, row by row, equally many for
// each cell.
[[nodiscard]] GapAttractors find_beside_branches(std::span<const quantities::StoredCell> cells,
                                                 std::span<const quantities::StoredAttractor> attractors,
                                                 std::int64_t columns);

}  // namespace peterka
