// A stable orbit that is known before a search begins, as a trajectory that nears it sees it.
//
// A trajectory that nearly recurs is compared with it first: whether it converges to this orbit is decided by
// the same test (regime/periodic_orbit.hpp) as for one that Newton's method finds, which is what it spares.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "regime/periodic_orbit.hpp"
#include "regime/stroboscopic_map.hpp"
#include "support/task.hpp"

namespace peterka::regime {

class KnownOrbit {
  public:
    // Points, one cycle after the other, and the cycles from them.
    KnownOrbit(Points points, std::vector<CycleResult> cycles)
        : points_(std::move(points)), cycles_(std::move(cycles)) {}

    [[nodiscard]] std::int64_t period() const { return static_cast<std::int64_t>(points_.size()); }
    // With the point first that lies nearest; nothing where none is near.
    [[nodiscard]] std::optional<PeriodicOrbit> seen_from(const Point& state) const;

  private:
    Points points_;
    std::vector<CycleResult> cycles_;
};

// The stable orbit of period q at a point that is known about. Takes some four rounds.
[[nodiscard]] Task<std::optional<KnownOrbit>> follow_known_orbit(StroboscopicMap& map, Point point,
                                                                 std::int64_t q);

}  // namespace peterka::regime
