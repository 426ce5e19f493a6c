// Orbits with changed events: where an impact is gained, lost or split, and where the events of a motion change
// while it continues smoothly.
#pragma once

#include <optional>

#include "curves/defining_system.hpp"
#include "curves/orbit_check.hpp"

namespace peterka::curves {

// Linear interpolation between two points with the same events.
[[nodiscard]] OrbitPoint between(const OrbitPoint& from, const OrbitPoint& to, double share);

// The difference of two points with the same events, in scaled unknowns.
[[nodiscard]] Eigen::VectorXd way_between(const Rig& rig, const OrbitPoint& from, const OrbitPoint& to,
                                          const PlanePoint& window);

[[nodiscard]] bool has_same_events(const Orbit& a, const Orbit& b);
// The same events, with the same velocities up to rounding.
[[nodiscard]] bool is_same_motion(const Orbit& a, const Orbit& b);

// The point told from another of its orbit's cycles on, as near as possible to an orbit with the same events;
// none if its events are others.
[[nodiscard]] std::optional<OrbitPoint> told_like(const Rig& rig, const OrbitPoint& point, const Orbit& like);

// The point with a grazing added where a flight reaches furthest.
[[nodiscard]] OrbitPoint with_grazing(const OrbitPoint& point, const OrbitFault& pierced);
// The same motion without its grazing as an event.
[[nodiscard]] OrbitPoint without_grazing(const OrbitPoint& grazing);

// Whether the grazing is no other event than the impact before it: an impact that takes all speed (r = 0)
// leaves the hammer at rest on the stop, as a grazing does. There it begins to stick, and gains no impact.
[[nodiscard]] bool is_impact_before_it(const Rig& rig, const OrbitPoint& grazing);

// The point with a grazing in place of an impact that has lost its speed: the impact is removed or, where the
// stop presses the hammer there, merges with the impact before it.
[[nodiscard]] std::optional<OrbitPoint> grazing_in_place_of(const Rig& rig, const OrbitPoint& point,
                                                            std::size_t event);

// The orbit beside one that grazes, with one more impact or with none in place of the grazing. Where the stop
// goes on to press, the contact then belongs to the impact before.
[[nodiscard]] OrbitPoint beyond_grazing(const Rig& rig, const OrbitPoint& grazing, bool gains);

// Where the stop's force just rises or falls to 0, the stop presses or releases for an instant: two events are
// born. An orbit with the two in reverse order solves the equations, too, but is not a motion. Returns the
// first event of such a pair, if any.
[[nodiscard]] std::optional<std::size_t> reversed_pair(const Rig& rig, const OrbitPoint& point);
[[nodiscard]] OrbitPoint without_pair(const OrbitPoint& point, std::size_t first);
// The pair interchanged: close to the motion that has both events if they lie close together.
[[nodiscard]] OrbitPoint with_pair_turned(const Rig& rig, const OrbitPoint& point, std::size_t first);

// The point with the events of the true motion; unchanged if they are the same, none if there is no such orbit.
[[nodiscard]] std::optional<OrbitPoint> with_true_events(const Rig& rig, const OrbitPoint& point);

// The orbit of smallest period that a point nearly repeats; the point itself if there is none.
[[nodiscard]] OrbitPoint with_smallest_period(const Rig& rig, const OrbitPoint& point, double nearness);

}  // namespace peterka::curves
