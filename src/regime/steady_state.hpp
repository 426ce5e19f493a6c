// The decision procedure: follows one start until its regime is proved, or the budget ends.
//
// - no impact: the decaying transient of the free flight can't reach the stop any more
// - sustained contact: the decaying transient of the contact can't make the force vanish, or a proved orbit has
//   no separation
// - periodic: a near-recurrence led Newton's method to a stable orbit, and the trajectory contracts to it
// - chaotic: for long enough (regime/chaos_claim.hpp) the largest Lyapunov exponent is positive by three
//   standard errors, and a perturbation grew by e^20; never if the hammer came to rest on a rigid stop twice,
//   as the motion then repeats, possibly after more than max_period cycles
// - unresolved: the budget ended, or nothing in the oscillator dissipates
//
// If attractors are known beforehand, a state in the neighbourhood of one of them ends the search: it certainly
// leads there, and takes the attractor's values.
//
// Peak force and impact rate of chaotic and unresolved cells are those of the cycles that count
// (regime/followed_trajectory.hpp).
#pragma once

#include <limits>

#include "job/job.hpp"
#include "regime/attractor_table.hpp"
#include "regime/cell_result.hpp"
#include "regime/cycle_broker.hpp"
#include "regime/engine.hpp"
#include "regime/observation.hpp"
#include "scene/oscillator.hpp"
#include "support/task.hpp"

namespace peterka::regime {

// start: (delta, delta') at forcing phase 0. Never throws for numerical reasons: those are the result's status.
// With an engine of its own, or as a task whose cycles are served at the broker.
CellResult find_steady_state(const scene::Oscillator<double>& oscillator, const scene::State<double>& start,
                             const job::SteadyState& budget, const EngineSettings& engine = {},
                             Measures measures = {});
// most_growth: ln of the growth of errors beyond which the search gives up.
Task<CellResult> find_steady_state(CycleBroker& broker, scene::Oscillator<double> oscillator,
                                   scene::State<double> start, job::SteadyState budget, EngineSettings engine,
                                   Measures measures, SearchContext attractors = {},
                                   double most_growth = std::numeric_limits<double>::infinity());

}  // namespace peterka::regime
