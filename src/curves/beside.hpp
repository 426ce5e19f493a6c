// The motions next to a point of a curve, on a line through it: those that end or change there.
#pragma once

#include <vector>

#include "curves/seed.hpp"

namespace peterka::curves {

// A short step away from the point, on either side of the curve. One that is stable at the curve may lose that
// at once: what is left of an impact that has hardly any speed is a jump of its multipliers.
struct Beside {
    bool any = false;
    std::vector<OrbitPoint> stable;
};

// On a line through the point in a direction of the plane. Without those of twice the period.
[[nodiscard]] Beside motions_beside(const Rig& rig, const PlanePoint& window, const Seed& at,
                                    const PlanePoint& way);

// Those of twice the period that are born at a period doubling.
[[nodiscard]] std::vector<OrbitPoint> stable_doubled_beside(const Rig& rig, const PlanePoint& window,
                                                            const OrbitPoint& at, const PlanePoint& way);

}  // namespace peterka::curves
