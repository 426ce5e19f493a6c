// The decision procedure: follow one start until its regime is proved, or the budget ends.
//
// - no impact: the decaying rest of the free flight can't reach the stop any more
// - sustained contact: the decaying rest of the contact can't make the force vanish, or a proved orbit never
//   separates
// - periodic: a near-recurrence led Newton's method to a stable orbit, and the trajectory contracts to it
// - chaotic: for long enough (see below) the largest Lyapunov exponent is positive by three standard errors,
// and
//   a perturbation grew by e^20; never where the hammer came to rest on a rigid stop twice, as the motion then
//   repeats, be it after more than max_period cycles
// - unresolved: the budget ran out, or nothing in the scene dissipates
//
// Where attractors are known beforehand, a state in the neighbourhood of one of them ends the search: it surely
// leads there, and takes the attractor's values.
//
// A chaotic claim speaks of the cycles observed: where no impact is possible too (steady free amplitude below
// the gap, or a contact that lasts), it may be a long transient, and chaos_cycles are asked for. Where not, 0.3
// of them. Either way more in a scene that loses little in a cycle, for transients live as long as areas take
// to shrink; and, where impacts go on for ever, more where Newton's method finds a stable orbit near by. Peak
// force and impact rate of chaotic and unresolved cells are those of the cycles after the first
// Growth::settling_cycles (after half the budget, if that is shorter).
#pragma once

#include <cstdint>
#include <limits>

#include "regime/attractor_table.hpp"
#include "regime/cell_result.hpp"
#include "regime/cycle_desk.hpp"
#include "regime/engine.hpp"
#include "regime/steady_motion.hpp"
#include "scene/oscillator.hpp"
#include "support/task.hpp"
#include "trajectory/recorder.hpp"

namespace peterka::regime {

// What is measured of a steady state.
struct Measures {
    trajectory::Detail detail = trajectory::Detail::force;
    bool force_per_cycle = false;
    SteadyMotion* motion = nullptr;  // filled where somebody wants it; outlives the search
};

struct Budget {
    std::int64_t max_cycles = 3000;
    std::int64_t max_period = 64;
    std::int64_t chaos_cycles = 1000;
    double most_growth =
        std::numeric_limits<double>::infinity();  // of errors, ln; beyond it the search gives up

    // Where impacts go on for ever.
    [[nodiscard]] std::int64_t fewest_chaos_cycles() const { return chaos_cycles * 3 / 10; }
};

// start: (delta, delta') at forcing phase 0. Never throws for numerical reasons: those are the result's status.
// With an engine of its own, or as a task whose cycles others serve at the desk.
CellResult find_steady_state(const scene::Oscillator<double>& scene, const scene::State<double>& start,
                             const Budget& budget, const EngineSettings& engine = {}, Measures measures = {});
Task<CellResult> find_steady_state(CycleDesk& desk, scene::Oscillator<double> scene, scene::State<double> start,
                                   Budget budget, EngineSettings engine, Measures measures,
                                   Attractors attractors = {});

}  // namespace peterka::regime
