// A cell of a map once it is solved, and the attractors that its starts end on, if it has several.
#pragma once

#include <cstdint>
#include <vector>

#include "cell/result.hpp"

namespace peterka::attractors {

using cell::CellAttractor;

// The first start that ended on an attractor, and what it is: of an orbit, which one.
struct FirstEnd {
    cell::CellResult result;
    std::int64_t start = 0;
};

struct SolvedCell {
    cell::CellResult cell;                  // from [start]
    std::vector<CellAttractor> attractors;  // by share, then regime, q, p and force; no more than the job keeps
    std::vector<cell::CellResult> ends = {};  // of each start, in their order, for who asks
    std::vector<FirstEnd> firsts = {};        // of each of `attractors`, the same
};

}  // namespace peterka::attractors
