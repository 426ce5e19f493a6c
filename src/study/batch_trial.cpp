#include "study/batch_trial.hpp"

#include <algorithm>
#include <limits>
#include <random>

#include "batch/batched_cycle_map.hpp"
#include "support/stop_request.hpp"
#include "support/stopwatch.hpp"

namespace peterka::study {
namespace {

using batch::BatchedCycleMap;

constexpr std::size_t usual_slots = 1024;  // as many as a map carries at once

// Slot n carries cell order[n]; the first slots carry each cell once, so that they can be found again.
std::vector<std::size_t> slots_in_order(std::size_t cells) {
    const std::size_t copies = std::max<std::size_t>(usual_slots / cells, 1);
    std::vector<std::size_t> order(cells * copies);
    for (std::size_t slot = 0; slot < order.size(); ++slot) order[slot] = slot % cells;
    std::shuffle(order.begin() + static_cast<std::ptrdiff_t>(cells), order.end(), std::mt19937(1));
    return order;
}

BatchedCycleMap filled(std::span<const OrbitStart> cells, const std::vector<std::size_t>& order) {
    const auto frequency = [](const OrbitStart& cell) { return cell.oscillator.frequency; };
    const OrbitStart& slowest = *std::ranges::min_element(cells, {}, frequency);
    BatchedCycleMap map(slowest.oscillator, order.size(),
                        BatchedCycleMap::steps_for(slowest.oscillator.frequency));
    for (const std::size_t number : order) {
        const OrbitStart& cell = cells[number];
        map.add(cell.oscillator.frequency, cell.oscillator.gap, cell.point);
    }
    return map;
}

Observation observed(const BatchedCycleMap& map, std::size_t slot) {
    const auto cycle = map.cycle(slot);
    return {cycle.outcome == trajectory::Cycle<double>::Outcome::done, cycle.end, cycle.impacts,
            map.peak_force(slot), std::numeric_limits<double>::quiet_NaN()};
}

}  // namespace

BatchTrial follow_in_batch(std::span<const OrbitStart> cells, std::int64_t cycles, std::int64_t repeats) {
    BatchTrial trial{0, std::vector<std::vector<Observation>>(cells.size())};
    if (cells.empty()) return trial;
    const std::vector<std::size_t> order = slots_in_order(cells.size());
    double fastest = std::numeric_limits<double>::infinity();
    BatchedCycleMap map = filled(cells, order);
    for (std::int64_t repeat = 0; repeat < repeats; ++repeat) {
        for (std::size_t slot = 0; slot < order.size(); ++slot) map.set_state(slot, cells[order[slot]].point);
        const Stopwatch stopwatch;
        for (std::int64_t n = 0; n < cycles; ++n) {
            stop_if_asked();
            map.advance();
        }
        fastest = std::min(fastest, stopwatch.seconds());
    }
    trial.seconds_per_cycle = fastest / static_cast<double>(cycles) / static_cast<double>(order.size());

    const std::size_t longest = std::ranges::max(cells, {}, &OrbitStart::period).period;
    for (std::size_t n = 0; n < longest; ++n) {
        map.advance();
        for (std::size_t cell = 0; cell < cells.size(); ++cell) {
            if (n < cells[cell].period) trial.orbits[cell].push_back(observed(map, cell));
        }
    }
    return trial;
}

}  // namespace peterka::study
