// The motions beside a point of a curve, on a line through it: those that end or change there.
#pragma once

#include <vector>

#include "curves/seed.hpp"

namespace peterka::curves {

// Motions a short step away from the point, on either side of the curve. A motion that is stable at the curve
// may lose stability at once: even an impact of vanishing speed makes its Floquet multipliers jump.
struct Beside {
    bool any = false;
    std::vector<OrbitPoint> stable;
};

// On the line through the point in the direction `way`, without the orbits of twice the period.
[[nodiscard]] Beside motions_beside(const Rig& rig, const PlanePoint& window, const Seed& at,
                                    const PlanePoint& way);

// The stable orbits of twice the period that are born at a period doubling.
[[nodiscard]] std::vector<OrbitPoint> stable_doubled_beside(const Rig& rig, const PlanePoint& window,
                                                            const OrbitPoint& at, const PlanePoint& way);

}  // namespace peterka::curves
