// A solved cell of a map, and the attractors on which its starts end, if it has several starts.
#pragma once

#include <cstdint>
#include <vector>

#include "cell/result.hpp"

namespace peterka::attractors {

using cell::CellAttractor;

// The first start that ended on an attractor, and its result, which tells the orbit, if there is one.
struct FirstEnd {
    cell::CellResult result;
    std::int64_t start = 0;
};

struct SolvedCell {
    cell::CellResult cell;                  // from [start]
    std::vector<CellAttractor> attractors;  // by share, then regime, q, p and force; no more than the job keeps
    std::vector<cell::CellResult> ends = {};  // of each start, in their order, if requested
    std::vector<FirstEnd> firsts = {};        // of each of `attractors`, if requested
};

}  // namespace peterka::attractors
