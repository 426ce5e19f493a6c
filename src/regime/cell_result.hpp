// The result of a cell, which this folder computes, named in its own namespace: see cell/result.hpp.
#pragma once

#include "cell/result.hpp"

namespace peterka::regime {

using cell::CellResult;
using cell::Engine;
using cell::goes_on;
using cell::has_period;
using cell::Regime;
using cell::regime_not_computed;
using cell::same_label;
using cell::Status;
using cell::unknown;

// Above this sensitivity rounding errors, about 1e-16, have grown so much that they may decide a label.
inline constexpr double rounding_decides = 20;

}  // namespace peterka::regime
