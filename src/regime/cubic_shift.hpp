// What the cubic part of the springs does to a periodic orbit that was found without it: two steps of Newton's
// method lead from that orbit to the one of the whole springs, at the price of two of its periods. No bound
// says as much: where an orbit's impacts are weak a small shift changes their force a lot, whatever its
// multipliers.
#pragma once

#include <cstdint>
#include <optional>

#include "regime/cell_result.hpp"
#include "regime/cycle_broker.hpp"
#include "regime/engine.hpp"
#include "scene/oscillator.hpp"
#include "support/task.hpp"

namespace peterka::regime {

struct CubicShift {
    // Relative change of the peak force, or of the orbit itself on a rigid stop, whose forces have no bound;
    // with what a third step might add. None where the whole springs have no stable orbit next to it with the
    // same contacts, or where it goes further than the engine was chosen for.
    std::optional<double> change;
    std::int64_t cycles = 0;  // spent
};

// oscillator: with the cubic term. without: a result of regime `periodic` of the same cell without it.
Task<CubicShift> shift_by_cubic(CycleBroker& broker, scene::Oscillator<double> oscillator,
                                EngineSettings engine, CellResult without);

}  // namespace peterka::regime
