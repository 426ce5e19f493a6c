// Which cells of a basin lead to the same attractor, and the order in which attractors are numbered. No file,
// no MPI.
//
// Periodic cells are distinguished by z = p/q and by the orbit's point at forcing phase 0; the other proved
// regimes are one attractor each. Cells that are unresolved, failed or not computed belong to none.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "quantities/fields.hpp"

namespace peterka::findings {

struct Attractor {
    quantities::StoredCell cell;  // the first cell found on it represents it
    std::int64_t cells = 0;       // number of cells that lead to it
};

inline constexpr std::int32_t no_attractor = -1;

[[nodiscard]] bool has_attractor(const quantities::StoredCell& cell);

// The first row that the cell belongs to; no_attractor if there is none.
[[nodiscard]] std::int32_t row_of(std::span<const Attractor> table, const quantities::StoredCell& cell);

// By regime, q, p, peak force (none on rigid stops), displacement, velocity: a numbering that follows from the
// attractors alone.
void sort_canonically(std::vector<Attractor>& table);

}  // namespace peterka::findings
