// Whether labels of the coarse map change along a curve and, if not, why: each curve ends or changes a stable
// motion, but a map shows that motion only in cells whose start leads to it.
#pragma once

#include "curves/coarse_map.hpp"
#include "curves/trace_curve.hpp"

namespace peterka::curves {

// For a curve just traced, which still has its orbits.
void tell_edges(const Rig& rig, const CoarseMap& map, Curve& curve);

}  // namespace peterka::curves
