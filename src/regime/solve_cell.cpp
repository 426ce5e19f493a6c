#include "regime/solve_cell.hpp"

#include "regime/steady_state.hpp"

namespace peterka::regime {

CellResult solve_cell(const scene::Scene& scene, std::int64_t row, std::int64_t column) {
    const job::SteadyState& steady = scene.job().steady_state;
    const scene::Cell cell = scene.cell(row, column);
    return find_steady_state(cell.oscillator, cell.start,
                             {.max_cycles = steady.max_cycles,
                              .max_period = steady.max_period,
                              .chaos_cycles = steady.chaos_cycles});
}

}  // namespace peterka::regime
