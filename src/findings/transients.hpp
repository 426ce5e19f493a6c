// How long impacts last that end: for the summary of a file that stores last_impact. Sums over cells, in any
// order.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "quantities/fields.hpp"

namespace peterka::findings {

struct Transients {
    // A run of so many forcing cycles would see impacts in `impacting` cells at its end.
    static constexpr std::array<std::int64_t, 6> looks{30, 100, 300, 1000, 3000, 10000};

    std::int64_t cells = 0;    // that count
    std::int64_t ended = 0;    // cells that end without impact, after some
    std::int64_t cycles = 0;   // until the last impact, of all of these together
    std::int64_t longest = 0;  // of one of them
    std::array<std::int64_t, looks.size()> impacting{};

    void add(const Transients& other);
    // A cell of a basin or a map; one that was filled, or is undecided, counts nowhere.
    void add(const quantities::StoredCell& cell);
};

}  // namespace peterka::findings
