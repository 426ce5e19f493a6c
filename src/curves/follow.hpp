// A stable orbit followed through the plane in a straight line, until it ends or becomes unstable: what happens
// there is a point of a curve.
#pragma once

#include <optional>

#include "curves/branch_step.hpp"

namespace peterka::curves {

// Stored as int8; the numbers are part of the file format.
enum class CurveKind : std::int8_t { fold = 0, period_doubling = 1, grazing = 2 };

struct Seed {
    CurveKind kind = CurveKind::fold;
    OrbitPoint point;
};

// What is asked of a point of a curve, besides the equations of its orbit.
[[nodiscard]] std::vector<Condition> conditions_of(CurveKind kind);

struct Followed {
    bool reached = false;      // the orbit is there and stable as far as it was followed
    std::optional<Seed> seed;  // or what it met before
};

// From a place on, to another; the step's length is a share of the window.
[[nodiscard]] Followed follow(const Rig& rig, const OrbitPoint& stable, const Place& target,
                              const Place& window);

// The orbit through a state at forcing phase 0, if there is one and it is stable.
[[nodiscard]] std::optional<OrbitPoint> stable_orbit_near(const Rig& rig, const Place& place,
                                                          const State<double>& state, std::int64_t period,
                                                          const Place& window);

// The motion without impacts where it just reaches the stop: a point of the curve on which it ends. None at a
// frequency at which its swing has no limit, or no positive gap is so wide.
[[nodiscard]] std::optional<Seed> reach_of_free_motion(const Rig& rig, double frequency, const Place& window);

}  // namespace peterka::curves
