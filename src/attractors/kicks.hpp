// The smallest sudden change of the hammer's velocity, at any phase, after which the settled motion ends
// elsewhere, for each periodic attractor of a cell. Each has its own scan (attractors/kick_scan.hpp); their
// searches run side by side.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "attractors/kick_scan.hpp"
#include "attractors/kicked_orbit.hpp"
#include "attractors/search_broker.hpp"
#include "attractors/tally.hpp"
#include "scene/oscillator.hpp"

namespace peterka::attractors {

class Kicks {
  public:
    using SearchFrom = std::function<SearchFactory(const scene::State<double>& start)>;

    // largest: largest kick tried, in A0 omega. known: neighbourhoods of the orbits; must outlive this.
    Kicks(const scene::Oscillator<double>& cell, std::span<const Tally::Entry> attractors, double largest,
          const regime::AttractorTable& known, SearchFrom search_from);

    // The next searches, given the outcomes of the previous ones in their order; none when done.
    [[nodiscard]] std::vector<SearchFactory> next(std::span<const SearchOutcome> ended);

    // The result for the attractor in this slot; nothing was tried where it is not periodic.
    [[nodiscard]] cell::Kick smallest(std::size_t slot);

  private:
    struct Kicked {
        std::size_t slot;
        regime::CellResult result;
        regime::FoundAttractor found;
        KickedOrbit orbit;
        KickScan scan;
        std::vector<bool> carried = {};  // of the last kicks: whether each has a search
    };

    bool kick(Kicked& kicked, std::span<const SearchOutcome>& ended, std::vector<SearchFactory>& searches);
    [[nodiscard]] static std::vector<KickScan::Outcome> take(const Kicked& kicked,
                                                             std::span<const SearchOutcome>& ended);

    scene::Oscillator<double> cell_;
    const regime::AttractorTable& known_;
    SearchFrom search_from_;
    std::vector<Kicked> kicked_;
};

}  // namespace peterka::attractors
