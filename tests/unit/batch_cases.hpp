// Cells, and a comparison of the batched engine with its scalar twin cell by cell.
#pragma once

#include <cstdint>
#include <vector>

#include "batch/batched_cycle_map.hpp"
#include "rig.hpp"

namespace peterka::testing {

// The 170 mm rig with a cubic spring.
inline scene::Oscillator<double> cubic_rig(double cubic, double frequency = 1, double gap = 0) {
    auto rig = paper_rig(beam_170mm, frequency, gap);
    rig.cubic = cubic;
    return rig;
}

struct BatchCell {
    double frequency;
    double gap;
    scene::State<double> state;
};

// Regular cells of the 170 mm rig: (eta, gap/A0), started at rest.
inline constexpr double regular_cells[8][2] = {{2.0, 0.0}, {1.3, 1.0}, {1.1, 4.0}, {3.5, 0.3},
                                               {2.75, 0},  {0.8, 0.2}, {3.1, 0.0}, {4.2, 0.5}};

// Random cells with starts in flight, in contact, unloaded, and on the stop.
std::vector<BatchCell> random_cells(unsigned seed, std::size_t count, double least_frequency,
                                    double largest_frequency, double least_gap, double largest_gap);

struct Comparison {
    std::int64_t cycles = 0;
    std::int64_t impacts = 0;
    std::int64_t left_to_twin = 0;
    std::int64_t different_events = 0;  // pattern, impacts, touched, separated, outcome
    std::int64_t grazes = 0;  // of these, where rounding decides: the twin itself differs from its neighbours
    std::int64_t different_totals = 0;  // impacts as they count, and chatter, of the same events
    std::int64_t chatters = 0;          // cycles with a completed one
    double totals = 0;                  // largest difference of what is gathered of them
    double state = 0;  // largest differences, relative to what a rounding error of the start makes
    double peak_force = 0;
    double jacobian = 0;        // relative to its own size, and to the slowest impact
    double bound_too_low = 0;   // of the displacement, against its true largest, relative
    double bound_too_high = 0;  // against the twin's bound
};

struct BatchGrid {
    BatchGrid(int steps, batch::Springs with = batch::Springs::linear)
        : steps_per_cycle(steps), springs(with) {}
    int steps_per_cycle;
    batch::Springs springs;
};

// So many cycles of both, the twin starting each from where the batch is.
Comparison compare_with_twin(const scene::Oscillator<double>& rig, std::vector<BatchCell> cells,
                             const BatchGrid& grid, int cycles);

// The same of cells with rigs of their own.
struct OwnRigCell {
    scene::Oscillator<double> oscillator;
    scene::State<double> state;
};
Comparison compare_with_twin(std::vector<OwnRigCell> cells, const BatchGrid& grid, int cycles);

}  // namespace peterka::testing
