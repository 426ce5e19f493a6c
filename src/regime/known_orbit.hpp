// A stable orbit known before a search begins, as seen from a trajectory that approaches it.
//
// A trajectory that nearly recurs is compared with it first: whether the trajectory converges to this orbit is
// decided by the same test (regime/periodic_orbit.hpp) as for an orbit found by Newton's method, whose cost is
// saved.
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
    // points: successive, one cycle apart. cycles: those from each point.
    KnownOrbit(Points points, std::vector<CycleResult> cycles)
        : points_(std::move(points)), cycles_(std::move(cycles)) {}

    [[nodiscard]] std::int64_t period() const { return static_cast<std::int64_t>(points_.size()); }
    // The orbit, its point nearest to the state first; nothing if none is near.
    [[nodiscard]] std::optional<PeriodicOrbit> seen_from(const Point& state) const;

  private:
    Points points_;
    std::vector<CycleResult> cycles_;
};

// The stable orbit of period q near an approximately known point. Takes about four rounds of q cycles.
[[nodiscard]] Task<std::optional<KnownOrbit>> follow_known_orbit(StroboscopicMap& map, Point point,
                                                                 std::int64_t q);

}  // namespace peterka::regime
