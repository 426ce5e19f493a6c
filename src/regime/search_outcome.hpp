// The outcome of a search, for its caller.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "regime/attractor_table.hpp"
#include "regime/cell_result.hpp"
#include "regime/cycle_broker.hpp"
#include "regime/known_orbit.hpp"
#include "regime/neighbourhood.hpp"
#include "support/task.hpp"

namespace peterka::regime {

struct SearchOutcome {
    CellResult result = {};                          // of a start
    std::vector<FoundAttractor> found = {};          // on the way to it, if collected
    std::optional<KnownOrbit> orbit = {};            // or what was learned about an attractor
    std::vector<Neighbourhood> neighbourhoods = {};  // proved
    std::int64_t cycles = 0;                         // spent
};

// The outcome of a search from one start.
[[nodiscard]] inline Task<SearchOutcome> outcome_of(Task<CellResult> search) {
    SearchOutcome outcome;
    outcome.result = co_await search;
    outcome.cycles = outcome.result.cycles;
    co_return outcome;
}

// Whether searches are on rigs that the scene has, or each on a rig of its own.
enum class Rigs { of_scene, of_each };

// Begins a search whose cycles are served at the broker.
using SearchFactory = std::function<Task<SearchOutcome>(CycleBroker& broker)>;

}  // namespace peterka::regime
