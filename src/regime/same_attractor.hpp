// Which results are of one attractor: periodic ones are told apart by z = p/q and by the orbit's point at
// forcing phase 0, the other regimes are one attractor each.
#pragma once

#include "regime/cell_result.hpp"
#include "regime/same_orbit.hpp"

namespace peterka::regime {

[[nodiscard]] inline bool same_attractor(const CellResult& a, const CellResult& b) {
    return a.regime == Regime::periodic ? same_orbit(a, b) : a.regime == b.regime;
}

}  // namespace peterka::regime
