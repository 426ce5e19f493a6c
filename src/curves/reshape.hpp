// The same orbit with other events: where an impact is gained, lost or split, and where the events of a motion
// change while it goes on smoothly.
#pragma once

#include <optional>

#include "curves/defining_system.hpp"
#include "curves/orbit_check.hpp"

namespace peterka::curves {

// A point a share of the way from one to another with the same events.
[[nodiscard]] OrbitPoint between(const OrbitPoint& from, const OrbitPoint& to, double share);

// From one to another with the same events, in sizes of the unknowns.
[[nodiscard]] Eigen::VectorXd way_between(const Rig& rig, const OrbitPoint& from, const OrbitPoint& to,
                                          const PlanePoint& window);

[[nodiscard]] bool has_same_events(const Orbit& a, const Orbit& b);
// The same events, with the same velocities but for rounding.
[[nodiscard]] bool is_same_motion(const Orbit& a, const Orbit& b);

// With a grazing where a flight reaches furthest.
[[nodiscard]] OrbitPoint with_grazing(const OrbitPoint& point, const OrbitFault& pierced);

// With a grazing in place of an impact that has lost its speed: it is left out, or, where the stop presses the
// hammer there, becomes one with the impact before.
[[nodiscard]] std::optional<OrbitPoint> grazing_in_place_of(const Rig& rig, const OrbitPoint& point,
                                                            std::size_t event);

// Of an orbit that grazes, the one next to it with an impact more, or with none in place of the grazing. Where
// the stop goes on to press, the impact before takes its contact.
[[nodiscard]] OrbitPoint beyond_grazing(const Rig& rig, const OrbitPoint& grazing, bool gains);

// Where the force of the stop just reaches 0, or just falls to it, the stop presses or lets go for an instant:
// two events are born. An orbit with both in reverse order obeys the equations, too, but is no motion. The
// first of them, if there are such.
[[nodiscard]] std::optional<std::size_t> reversed_pair(const Rig& rig, const OrbitPoint& point);
[[nodiscard]] OrbitPoint without_pair(const OrbitPoint& point, std::size_t first);
// With each in the place of the other: close to the motion that has both, where they lie close together.
[[nodiscard]] OrbitPoint with_pair_turned(const Rig& rig, const OrbitPoint& point, std::size_t first);

// With the events of the true motion; the same point where these are no others, and none where it has no orbit.
[[nodiscard]] std::optional<OrbitPoint> with_true_events(const Rig& rig, const OrbitPoint& point);

// The orbit of a divisor's period that a point nearly is; itself where there is none.
[[nodiscard]] OrbitPoint with_smallest_period(const Rig& rig, const OrbitPoint& point, double nearness);

}  // namespace peterka::curves
