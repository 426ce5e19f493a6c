#include "regime/free_cells.hpp"

#include <algorithm>
#include <functional>
#include <limits>

#include "regime/solve_cell.hpp"
#include "trajectory/free_flight.hpp"

namespace peterka::regime {

namespace {

// The start's u, which doesn't depend on the gap.
double displacement_of(const scene::Cell& cell) {
    return cell.start[0] + cell.oscillator.gap;
}

double farthest_gap(const scene::Scene& scene) {
    double farthest = -std::numeric_limits<double>::infinity();
    for (const std::int64_t row : {std::int64_t{0}, std::max<std::int64_t>(scene.rows() - 1, 0)}) {
        for (const std::int64_t column : {std::int64_t{0}, std::max<std::int64_t>(scene.columns() - 1, 0)}) {
            farthest = std::max(farthest, scene.cell(row, column).oscillator.gap);
        }
    }
    return farthest;
}

}  // namespace

FreeCells::FreeCells(const scene::Scene& scene) : scene_(scene), farthest_(farthest_gap(scene)) {}

bool FreeCells::RecentCell::tells_of(const scene::Cell& cell) const {
    return frequency == cell.oscillator.frequency && gap <= cell.oscillator.gap &&
           displacement == displacement_of(cell) && velocity == cell.start[1];
}

std::size_t FreeCells::place_of(const scene::Cell& cell) {
    return std::hash<double>()(cell.oscillator.frequency) % places;
}

bool FreeCells::may_be_free(const scene::Cell& cell) {
    if (scene_.rigs_differ()) return true;  // as far as is known
    Swing& swing = swings_[place_of(cell)];
    if (swing.frequency != cell.oscillator.frequency) {
        const trajectory::FreeFlight<double> flight(without_cubic(cell.oscillator));
        swing = {cell.oscillator.frequency, flight.amplitude()};
    }
    return swing.amplitude < cell.oscillator.gap;
}

std::optional<CellResult> FreeCells::compute(const scene::Cell& cell) {
    ++computed_;
    return solve_at_once(scene_.job(), cell);
}

std::optional<CellResult> FreeCells::told_by_another(const scene::Cell& cell) const {
    const RecentCell& known = known_[place_of(cell)];
    if (!known.tells_of(cell)) return std::nullopt;
    std::optional<CellResult> result = known.result;
    const double gap = cell.oscillator.gap;
    result->orbit_displacement = (known.steady_displacement - gap) + gap;  // rounded like the cell's own delta
    return result;
}

std::optional<CellResult> FreeCells::find(const scene::Cell& cell) {
    if (!may_be_free(cell)) return std::nullopt;
    const std::optional<CellResult> result = compute(cell);
    // without damping the start's free vibration persists, and its part rounds differently with every gap
    if (!result || scene_.rigs_differ() || cell.oscillator.damping_ratio == 0) return result;
    scene::Cell farthest = cell;
    farthest.oscillator.gap = farthest_;
    farthest.start[0] = displacement_of(cell) - farthest_;
    if (!compute(farthest)) return result;
    scene::Oscillator<double> without_stop = without_cubic(cell.oscillator);
    without_stop.gap = 0;
    known_[place_of(cell)] = {.frequency = cell.oscillator.frequency,
                              .displacement = displacement_of(cell),
                              .velocity = cell.start[1],
                              .gap = cell.oscillator.gap,
                              .steady_displacement = trajectory::FreeFlight<double>(without_stop).steady()[0],
                              .result = *result};
    return result;
}

}  // namespace peterka::regime
