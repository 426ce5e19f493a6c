// The motion without impacts, an ellipse in the plane of the hammer's state: where it just reaches the stop it
// ends, and a curve of grazings passes.
#pragma once

#include <optional>
#include <vector>

#include "curves/seed.hpp"

namespace peterka::curves {

// How far it stays from the stop, in A0; below 0 where it would reach beyond, without limit at a resonance
// without damping.
[[nodiscard]] double room_of_free_motion(const Rig& rig, const PlanePoint& place);

// Frequencies at which it just reaches the stop.
[[nodiscard]] std::vector<double> frequencies_with_swing(const PlacedRig& rig);

[[nodiscard]] PlanePoint on_way(const PlanePoint& from, const PlanePoint& to, double share);

// Between two places with room on one side only, the share of the way from one to the other; none elsewhere.
[[nodiscard]] std::optional<double> share_at_end_of_free_motion(const Rig& rig, const PlanePoint& from,
                                                                const PlanePoint& to);

// The same as a point of the curve.
[[nodiscard]] std::optional<Seed> end_of_free_motion(const Rig& rig, const PlanePoint& from,
                                                     const PlanePoint& to, const PlanePoint& window);

}  // namespace peterka::curves
