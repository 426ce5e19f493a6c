// The smallest sudden change of the hammer's velocity, at any phase, after which the settled motion ends
// elsewhere, for each periodic attractor of a cell: each by a scan of its own (attractors/kick_scan.hpp), whose
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

    // largest: of the kicks tried, in A0 omega.
    // known: neighbourhoods of the orbits, which outlive this.
    Kicks(const scene::Oscillator<double>& cell, std::span<const Tally::Entry> attractors, double largest,
          const regime::AttractorTable& known, SearchFrom search_from);

    // The next searches, once the last ones have ended, whose outcomes are given in their order; none: it is
    // done.
    [[nodiscard]] std::vector<SearchFactory> next(std::span<const SearchOutcome> ended);

    // Of the attractor in this slot; nothing was tried where it is not periodic.
    [[nodiscard]] cell::Kick smallest(std::size_t slot);

  private:
    struct Kicked {
        std::size_t slot;
        regime::CellResult result;
        regime::FoundAttractor found;
        KickedOrbit orbit;
        KickScan scan;
        std::vector<bool> carried = {};  // of the last kicks: the others have no search
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
