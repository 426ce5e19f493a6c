// A solved cell of a map, the attractors on which its starts end, if it has several starts, and what the rigs
// drawn for it end in, if rigs are uncertain.
#pragma once

#include <cstdint>
#include <vector>

#include "cell/result.hpp"

namespace peterka::attractors {

using cell::CellAttractor;
using cell::CellOutcome;

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
    std::vector<CellOutcome> outcomes = {};   // of the rigs drawn: the most likely, then by regime, q and p
    std::vector<cell::CellResult> ends_of_rigs = {};  // of each rig drawn, if requested
};

}  // namespace peterka::attractors
