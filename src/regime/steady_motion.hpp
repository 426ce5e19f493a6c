// The motion that a search ends in, for those who go on from there or draw it.
#pragma once

#include <cstddef>
#include <optional>

#include "scene/oscillator.hpp"
#include "support/latest.hpp"
#include "trajectory/recorder.hpp"

namespace peterka::regime {

// Of an orbit, all of it: its q points in their order from the one with the smallest delta, and the first
// touches of one period from there. Of a motion without a proof, the last ones of the window in which force is
// measured. At most so many of each as there is room for, the last ones; none where the cell failed.
struct SteadyMotion {
    explicit SteadyMotion(std::size_t room) : stroboscopic(room), touches(room) {}

    Latest<scene::State<double>> stroboscopic;  // (delta, delta') at forcing phase 0
    Latest<trajectory::Touch<double>> touches;  // of impacts
    std::optional<scene::State<double>> end =
        {};  // (delta, delta') at forcing phase 0, after whole cycles from the
             // start: the point of the orbit to which the trajectory contracts,
             // or where it is when the search gives up; none where it failed
};

}  // namespace peterka::regime
