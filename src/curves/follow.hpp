// A stable orbit followed through the plane in a straight line, until it ends or becomes unstable: what happens
// there is a point of a curve.
#pragma once

#include <functional>
#include <optional>

#include "curves/seed.hpp"

namespace peterka::curves {

struct FollowedOrbit {
    bool reached = false;      // the orbit is there and stable as far as it was followed
    std::optional<Seed> seed;  // or what it met before
    PlanePoint last;           // as far as it was followed
};

// Looks at a step from here to there, as far as its motion goes on; false where it was too long to be trusted.
using StepVisitor =
    std::function<bool(const OrbitPoint& here, const OrbitPoint& there, const PlanePoint& until)>;

// From a place on, to another; the step's length is a share of the window.
[[nodiscard]] FollowedOrbit follow(const Rig& rig, const OrbitPoint& stable, const PlanePoint& target,
                                   const PlanePoint& window, const StepVisitor& look = {});

// The orbit through a state at forcing phase 0, if there is one and it is stable.
[[nodiscard]] std::optional<OrbitPoint> stable_orbit_near(const Rig& rig, const PlanePoint& place,
                                                          const State<double>& state, std::int64_t period,
                                                          const PlanePoint& window);

}  // namespace peterka::curves
