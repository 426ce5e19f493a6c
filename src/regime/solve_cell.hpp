// One cell of a map or a basin: a pure function of the scene and the cell's place.
#pragma once

#include <cstdint>
#include <optional>

#include "regime/cell_result.hpp"
#include "regime/cycle_broker.hpp"
#include "regime/search_outcome.hpp"
#include "regime/steady_state.hpp"
#include "scene/scene.hpp"

namespace peterka::regime {

// With engines of its own, or as a task whose cycles are served at the broker.
CellResult solve_cell(const scene::Scene& scene, std::int64_t row, std::int64_t column);
Task<CellResult> solve_cell(CycleBroker& broker, const scene::Scene& scene, std::int64_t row,
                            std::int64_t column, SearchContext attractors = {});
// The same from any start; `motion`, if requested, receives the motion in which the search ends.
Task<CellResult> solve_cell(CycleBroker& broker, const job::Job& job, scene::Cell cell,
                            SearchContext attractors = {}, SteadyMotion* motion = nullptr);

// The same, with the attractors found on the way.
Task<SearchOutcome> search_cell(CycleBroker& broker, const job::Job& job, scene::Cell cell,
                                SearchContext attractors);

// The same result without any cycle, if the start alone shows that the stop is never met; else nothing.
std::optional<CellResult> solve_at_once(const job::Job& job, const scene::Cell& cell);

// The same cell with every term of the model, by an integrator other than the engine that solved it first. It
// shares only the decision procedure with the closed form.
CellResult solve_again(const scene::Scene& scene, std::int64_t row, std::int64_t column, Engine first_engine);
CellResult solve_again(const job::Job& job, const scene::Cell& cell, Engine first_engine);

}  // namespace peterka::regime
