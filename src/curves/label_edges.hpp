// Whether labels of the coarse map change along a curve, and, where they don't, why: each curve ends or changes
// a stable motion, but a map shows one only where its start ends on it and where it has a cell.
#pragma once

#include "curves/coarse_map.hpp"
#include "curves/trace_curve.hpp"

namespace peterka::curves {

// Of a curve that was just traced, whose orbits are there.
void tell_edges(const Rig& rig, const CoarseMap& map, Curve& curve);

}  // namespace peterka::curves
