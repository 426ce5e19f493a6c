// What the cubic part of the springs does to a periodic orbit that was found without it: Newton's method leads
// from that orbit to the one of the whole springs, at the price of some cycles. So a cell next to a
// bifurcation, of which a bound tells nothing, needs no second run from its start.
#pragma once

#include <cstdint>
#include <optional>

#include "regime/cell_result.hpp"
#include "regime/cycle_desk.hpp"
#include "regime/engine.hpp"
#include "scene/oscillator.hpp"
#include "support/task.hpp"

namespace peterka::regime {

struct CubicShift {
    // Relative change of the peak force. None where the whole springs have no stable orbit there with as many
    // impacts in as many cycles, where it goes further than the engine was chosen for, or on a rigid stop.
    std::optional<double> of_peak_force;
    std::int64_t cycles = 0;  // spent
};

// scene: with the cubic term. without: a result of regime `periodic` of the same cell without it.
Task<CubicShift> shift_by_cubic(CycleDesk& desk, scene::Oscillator<double> scene, EngineSettings engine,
                                CellResult without);

}  // namespace peterka::regime
