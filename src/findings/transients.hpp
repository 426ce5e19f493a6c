// Durations of impacting transients, for the summary of a file that stores last_impact. Sums over cells, in any
// order.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "quantities/fields.hpp"

namespace peterka::findings {

struct Transients {
    // A run of looks[i] forcing cycles would see impacts in impacting[i] cells at its end.
    static constexpr std::array<std::int64_t, 6> looks{30, 100, 300, 1000, 3000, 10000};

    std::int64_t cells = 0;    // counted
    std::int64_t ended = 0;    // cells that settle without impact, after some impacts
    std::int64_t cycles = 0;   // until the last impact, total of these cells
    std::int64_t longest = 0;  // largest of these
    std::array<std::int64_t, looks.size()> impacting{};

    void add(const Transients& other);
    // Adds a cell of a basin or a map; filled and undecided cells are skipped.
    void add(const quantities::StoredCell& cell);
};

}  // namespace peterka::findings
