// Whether a solution of the orbit equations is a motion of the hammer: the equations ignore what a leg does
// between its events.
#pragma once

#include <cstddef>
#include <cstdint>

#include "curves/rig.hpp"
#include "curves/unknowns.hpp"

namespace peterka::curves {

struct OrbitFault {
    enum class Kind : std::uint8_t {
        none,
        pierces,  // a flight reaches beyond the stop before its end
        slow,     // an impact has lost its speed
        pattern,  // the stop releases, or presses again, in between: the motion continues smoothly with other
                  // events
    };
    Kind kind = Kind::none;
    std::size_t event = 0;  // where the leg begins, or which lost its speed
    double time = 0;        // pierces: when the flight reaches furthest
};

// The first fault that ends a branch (pierces, slow), or else a pattern fault.
[[nodiscard]] OrbitFault find_fault(const Rig& rig, const OrbitPoint& point);

// Largest F/(k A0) of the orbit; NaN with a rigid stop.
[[nodiscard]] double peak_force(const Rig& rig, const OrbitPoint& point);

}  // namespace peterka::curves
