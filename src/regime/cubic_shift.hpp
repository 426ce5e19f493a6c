// The effect of the springs' cubic term on a periodic orbit found without it: two Newton steps lead from that
// orbit to the one of the full springs, at the cost of two of its periods. No bound gives as much: where an
// orbit's impacts are weak, a small shift changes their force a lot, whatever its multipliers.
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
    // Relative change of the peak force or, on a rigid stop, whose forces have no bound, of the orbit itself
    // and, where the result without has one, of the largest impact speed; includes what a third step might add.
    // None if the full springs have no stable orbit nearby with the same contacts, or if it goes further than
    // the engine was chosen for.
    std::optional<double> change;
    std::int64_t cycles = 0;  // spent
};

// oscillator: with the cubic term. without: a result of regime `periodic` of the same cell without it.
Task<CubicShift> shift_by_cubic(CycleBroker& broker, scene::Oscillator<double> oscillator,
                                EngineSettings engine, CellResult without);

}  // namespace peterka::regime
