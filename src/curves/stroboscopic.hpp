// The stroboscopic (Poincare) points of an orbit: its states at forcing phase 0.
#pragma once

#include <vector>

#include "curves/rig.hpp"
#include "curves/unknowns.hpp"

namespace peterka::curves {

struct Stroboscopic {
    State<double> state;
    double time = 0;  // tau, as in the orbit's events
};

// One for each of its q cycles, in order.
[[nodiscard]] std::vector<Stroboscopic> stroboscopic_states(const Rig& rig, const OrbitPoint& point);

}  // namespace peterka::curves
