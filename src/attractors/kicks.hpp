// The smallest sudden change of the hammer's velocity, at any phase, after which the settled motion ends
// elsewhere, for each periodic attractor of a cell. Each has its own scan (attractors/kick_scan.hpp); their
// searches run side by side.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "attractors/search_broker.hpp"
#include "attractors/tally.hpp"
#include "regime/attractor_table.hpp"
#include "scene/oscillator.hpp"
#include "support/task.hpp"

namespace peterka::attractors {

struct KickedCell {
    scene::Oscillator<double> oscillator;
    double largest;                       // kick tried [A0 omega]
    const regime::AttractorTable& known;  // neighbourhoods of the orbits
    std::function<SearchFactory(const scene::State<double>& start)> search_from;
};

// One for each attractor; nothing is tried on those that are not periodic. What it refers to must outlive the
// task.
[[nodiscard]] Task<std::vector<cell::Kick>> smallest_kicks(SearchBroker& broker, const KickedCell& cell,
                                                           std::span<const Tally::Entry> attractors);

}  // namespace peterka::attractors
