// Which results belong to one attractor: periodic ones are distinguished by z = p/q and by the orbit's point at
// forcing phase 0; the other regimes are one attractor each.
#pragma once

#include "regime/cell_result.hpp"
#include "regime/same_orbit.hpp"

namespace peterka::regime {

// Cell: as solved or as stored.
template <class Cell>
[[nodiscard]] bool same_attractor(const Cell& a, const Cell& b) {
    return a.regime == Regime::periodic ? same_orbit(a, b) : a.regime == b.regime;
}

}  // namespace peterka::regime
