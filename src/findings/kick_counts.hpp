// Statistics of the critical kicks of a map's cells, independent of the grouping of cells.
#pragma once

#include <cstdint>
#include <span>

#include "parallel/tiles.hpp"
#include "quantities/fields.hpp"

namespace peterka::findings {

struct KickCounts {
    std::int64_t kicked = 0;  // cells with a kicked orbit: the one with the largest share, or the cell's
    std::int64_t thrown = 0;  // of these, with a kick that leads elsewhere
    std::int64_t alone = 0;   // without such a kick, and no other motion is known
    // The smallest kick that leads elsewhere [m/s], its phase in forcing cycles, its cell, and whether that is
    // one whose label rounding may decide; 0 m/s if there is none.
    double smallest = 0;
    double phase = 0;
    std::int64_t row = -1;
    std::int64_t column = -1;
    std::int64_t by_rounding = 0;
    double least_tried = 0;    // in cells without such a kick [m/s]; 0 if there are none
    double most_tried = 0;     // in these cells, too
    std::int64_t bounded = 0;  // cells with a verified lower bound
    double least_bound = 0;    // of these bounds [m/s]; 0 if there are none

    void add(const KickCounts& other);
};

// Adds a cell without [starts], or with them: `here` holds its attractors, the largest share first.
void add_kick(KickCounts& counts, const quantities::StoredCell& cell, const parallel::CellIndex& place);
void add_kick(KickCounts& counts, std::span<const quantities::StoredAttractor> here,
              const parallel::CellIndex& place);

}  // namespace peterka::findings
