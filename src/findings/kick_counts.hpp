// What the critical kicks of a map's cells say together. Sums: the same in any grouping of cells.
#pragma once

#include <cstdint>
#include <span>

#include "quantities/fields.hpp"

namespace peterka::findings {

struct KickCounts {
    std::int64_t kicked =
        0;  // cells with an orbit that was kicked: the one with the largest share, or the cell's
    std::int64_t thrown = 0;   // of these, with a kick after which it ends elsewhere
    std::int64_t alone = 0;    // with none, and no other motion is known
    double smallest = 0;       // kick of those that are thrown [m/s]; 0 where there are none
    double phase = 0;          // of it, in forcing cycles
    double least_tried = 0;    // of those without one [m/s]; 0 where there are none
    double most_tried = 0;     // of these, too
    std::int64_t bounded = 0;  // with a verified lower bound
    double least_bound = 0;    // of these [m/s]; 0 where there are none

    void add(const KickCounts& other);
};

// One more cell without [starts], or with them: here are its attractors, the largest share first.
void add_kick(KickCounts& counts, const quantities::StoredCell& cell);
void add_kick(KickCounts& counts, std::span<const quantities::StoredAttractor> here);

}  // namespace peterka::findings
