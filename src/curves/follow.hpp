// A stable orbit followed through the plane along a straight line until it ends or loses stability, at a point
// of a curve.
#pragma once

#include <functional>
#include <optional>

#include "curves/seed.hpp"

namespace peterka::curves {

struct FollowedOrbit {
    bool reached = false;      // the orbit exists and is stable up to the target
    std::optional<Seed> seed;  // or what it met before
    PlanePoint last;           // the last place reached
};

// Examines a step from `here` to `there`, as far as `until`; false if the step was too long to be trusted.
using StepVisitor =
    std::function<bool(const OrbitPoint& here, const OrbitPoint& there, const PlanePoint& until)>;

// From the place of `stable` to `target`; the step's length is a share of the window.
[[nodiscard]] FollowedOrbit follow(const Rig& rig, const OrbitPoint& stable, const PlanePoint& target,
                                   const PlanePoint& window, const StepVisitor& look = {});

// The stable orbit through a state at forcing phase 0, if there is one.
[[nodiscard]] std::optional<OrbitPoint> stable_orbit_near(const Rig& rig, const PlanePoint& place,
                                                          const State<double>& state, std::int64_t period,
                                                          const PlanePoint& window);

}  // namespace peterka::curves
