// An orbit as a stroboscope sees it: its states at forcing phase 0.
#pragma once

#include <vector>

#include "curves/rig.hpp"
#include "curves/unknowns.hpp"

namespace peterka::curves {

struct Stroboscopic {
    State<double> state;
    double time = 0;  // tau, in the orbit's own count
};

// One for each of its q cycles, in their order.
[[nodiscard]] std::vector<Stroboscopic> stroboscopic_states(const Rig& rig, const OrbitPoint& point);

}  // namespace peterka::curves
