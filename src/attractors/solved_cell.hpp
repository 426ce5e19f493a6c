// A cell of a map once it is solved, and the attractors that its starts end on, if it has several.
#pragma once

#include <cstdint>
#include <vector>

#include "regime/cell_result.hpp"

namespace peterka::attractors {

struct CellAttractor {
    regime::Regime regime = static_cast<regime::Regime>(regime::regime_not_computed);
    std::int32_t impacts = -1;
    std::int32_t period = -1;
    double peak_force = regime::unknown;     // F/(k A0)
    double share = 0;                        // of the cell's starts
    double critical_kick = regime::unknown;  // smallest change of velocity that ends elsewhere, in A0 omega
};

struct SolvedCell {
    regime::CellResult cell;                // from [start]
    std::vector<CellAttractor> attractors;  // by share, then regime, q, p and force; no more than the job keeps
    std::vector<regime::CellResult> ends = {};  // of each start, in their order, for who asks
};

}  // namespace peterka::attractors
