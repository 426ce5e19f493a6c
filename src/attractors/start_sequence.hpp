// The starts of a cell: a low-discrepancy sequence over the rectangle of [starts], the same in every cell.
//
// The n-th point of the unit square is the fractional part of 1/2 + n (1/g, 1/g^2), g^3 = g + 1: the sequence
// R2 of M. Roberts (2018), whose first n points leave only small holes for any n. Computed in integers, it is
// the same on any machine. Displacements beyond the stop are not allowed: the rectangle is squeezed to end
// there.
#pragma once

#include <cstdint>

#include "job/job.hpp"
#include "scene/scene.hpp"

namespace peterka::attractors {

// Ends of a side of the rectangle, in the units of the cell: x(0)/A0 and x'(0)/(A0 omega).
struct Interval {
    double from;
    double to;
};
[[nodiscard]] Interval displacements_of(const job::Starts& starts, const scene::Scales& scales);
[[nodiscard]] Interval velocities_of(const job::Starts& starts, const scene::Scales& scales);

// Start n of this cell: (delta, delta') at forcing phase 0.
[[nodiscard]] scene::State<double> start_of(const job::Starts& starts, const scene::Cell& cell, std::int64_t n);

}  // namespace peterka::attractors
