// A cell of a map once it is solved, and the attractors that its starts end on, if it has several.
#pragma once

#include <vector>

#include "cell/result.hpp"

namespace peterka::attractors {

using cell::CellAttractor;

struct SolvedCell {
    cell::CellResult cell;                  // from [start]
    std::vector<CellAttractor> attractors;  // by share, then regime, q, p and force; no more than the job keeps
    std::vector<cell::CellResult> ends = {};  // of each start, in their order, for who asks
};

}  // namespace peterka::attractors
