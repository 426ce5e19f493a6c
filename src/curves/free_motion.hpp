// The motion without impacts, an ellipse in the hammer's state plane. It ends where it just reaches the stop,
// on a grazing curve.
#pragma once

#include <optional>
#include <vector>

#include "curves/seed.hpp"

namespace peterka::curves {

// Its clearance from the stop, in A0; negative where it would reach beyond, without limit at an undamped
// resonance.
[[nodiscard]] double room_of_free_motion(const Rig& rig, const PlanePoint& place);

// Frequencies at which it just reaches the stop.
[[nodiscard]] std::vector<double> frequencies_with_swing(const PlacedRig& rig);

[[nodiscard]] PlanePoint on_way(const PlanePoint& from, const PlanePoint& to, double share);

// The share of the way between two places at which the clearance changes sign; none if it does not.
[[nodiscard]] std::optional<double> share_at_end_of_free_motion(const Rig& rig, const PlanePoint& from,
                                                                const PlanePoint& to);

// The same as a point of the grazing curve.
[[nodiscard]] std::optional<Seed> end_of_free_motion(const Rig& rig, const PlanePoint& from,
                                                     const PlanePoint& to, const PlanePoint& window);

}  // namespace peterka::curves
