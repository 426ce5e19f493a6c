#include "batch_cases.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "trajectory/exact_cycle_map.hpp"
#include "trajectory/recorder.hpp"
#include "trajectory/split_cycle_map.hpp"

namespace peterka::testing {

namespace {

using trajectory::Cycle;
using trajectory::Recorder;

struct Twin {
    scene::Oscillator<double> oscillator;
    std::function<Cycle<double>(const scene::State<double>&, Recorder<double>*)> map;
    Cycle<double> operator()(const scene::State<double>& x, Recorder<double>* recorder = nullptr) const {
        return map(x, recorder);
    }
};

Twin twin_of(const scene::Oscillator<double>& oscillator, const BatchGrid& grid) {
    if (grid.springs == batch::Springs::split) {
        return {oscillator, trajectory::SplitCycleMap<double>(oscillator, grid.steps_per_cycle)};
    }
    if (scene::is_rigid(oscillator.contact)) return {oscillator, trajectory::RigidExactMap<double>(oscillator)};
    return {oscillator, trajectory::ExactCycleMap<double>(oscillator)};
}

bool same_events(const Cycle<double>& a, const Cycle<double>& b) {
    return a.pattern == b.pattern && a.impacts == b.impacts && a.touched == b.touched &&
           a.separated == b.separated && a.outcome == b.outcome;
}

// Starts that differ by less than the rounding errors of both engines have different events: a graze.
bool is_graze(const Twin& twin, const scene::State<double>& x, const Cycle<double>& expected) {
    const double tiny = 1e-13 * (1 + std::abs(twin.oscillator.gap) + x.norm());
    for (const auto& shift : {scene::State<double>(tiny, 0), scene::State<double>(-tiny, 0),
                              scene::State<double>(0, tiny), scene::State<double>(0, -tiny)}) {
        if (!same_events(twin(x + shift), expected)) return true;
    }
    return false;
}

// Upper bound of the largest singular value: the growth of a rounding error of the start.
double growth(const Cycle<double>& cycle) {
    return 1 + cycle.jacobian.norm();
}

// The same for the largest growth on the way: a rigid stop of small restitution contracts afterwards, and
// sticking contracts completely.
double growth_on_way(const Twin& twin, const scene::State<double>& x, const Cycle<double>& cycle) {
    if (!scene::is_rigid(twin.oscillator.contact)) return growth(cycle);
    constexpr int parts = 32;
    const trajectory::RigidExactMap<double> map(twin.oscillator);
    double largest = growth(cycle);
    for (int part = 1; part < parts; ++part) {
        largest = std::max(largest, growth(map.part(x, 0, twin.oscillator.period() * part / parts)));
    }
    return largest;
}

// Impact totals on a rigid stop, relative to the twin's.
void compare_totals(const trajectory::Totals<double>& told, const trajectory::Totals<double>& expected,
                    double most_growth, Comparison& result) {
    if (told.impacts != expected.impacts || told.chatter != expected.chatter ||
        told.struck_rigid_stop != expected.struck_rigid_stop) {
        ++result.different_totals;
    }
    result.chatters += expected.chatter ? 1 : 0;
    using Totals = trajectory::Totals<double>;
    for (const auto number :
         {&Totals::impact_speed, &Totals::impulse, &Totals::contact_time, &Totals::contact_work}) {
        const double difference = std::abs(told.*number - expected.*number) / (1 + expected.*number);
        result.totals = std::max(result.totals, difference / most_growth);
    }
}

void compare(const Twin& twin, const scene::State<double>& x, const batch::BatchedCycleMap& map,
             std::size_t slot, Comparison& result) {
    Recorder<double> recorder(trajectory::Detail::contacts);
    const Cycle<double> expected = twin(x, &recorder);
    const Cycle<double> cycle = map.cycle(slot);
    ++result.cycles;
    result.impacts += expected.impacts;
    if (!same_events(cycle, expected)) {
        ++result.different_events;
        if (is_graze(twin, x, expected)) ++result.grazes;
        return;
    }
    if (expected.outcome != Cycle<double>::Outcome::done) return;
    const double size = 1 + std::abs(twin.oscillator.gap) + x.norm() + expected.end.norm();
    result.state = std::max(result.state, (cycle.end - expected.end).norm() / (size * growth(expected)));
    const double most_growth = growth_on_way(twin, x, expected);
    // a hammer at rest on a rigid stop is pressed by the difference of forcing and springs
    const bool rigid = scene::is_rigid(twin.oscillator.contact);
    const double force =
        recorder.totals().largest_force + (rigid ? twin.oscillator.drive() + std::abs(twin.oscillator.gap) : 0);
    const double force_difference = std::abs(map.peak_force(slot) - recorder.totals().largest_force);
    if (force_difference > 0) {
        result.peak_force = std::max(result.peak_force, force_difference / (force * most_growth));
    }
    // Near grazing the impact speed v is the square root of twice the missed height times the acceleration,
    // and the Jacobian is O(1/v): an error of the height changes it by that error times 1/v^3.
    const double jacobian = (cycle.jacobian - expected.jacobian).norm() / std::pow(most_growth, 3);
    result.jacobian = std::max(result.jacobian, jacobian);
    const double bound = map.displacement_bound(slot);
    const auto& totals = recorder.totals();
    // where a rigid stop is pressed at phase 0, chatter continues across the ends of cycles
    if (rigid && twin.oscillator.gap >= 0) compare_totals(map.totals(slot), totals, most_growth, result);
    result.bound_too_low = std::max(result.bound_too_low, 1 - bound / totals.largest_displacement);
    result.bound_too_high = std::max(result.bound_too_high, bound / totals.displacement_bound - 1);
}

// Advances cells already in the batch by this many cycles.
template <class Cell>
Comparison compare_cycles(batch::BatchedCycleMap& map, const std::vector<Twin>& twins, std::vector<Cell>& cells,
                          int cycles) {
    Comparison result;
    for (int cycle = 0; cycle < cycles; ++cycle) {
        map.advance();
        for (std::size_t n = 0; n < cells.size(); ++n) {
            compare(twins[n], cells[n].state, map, n, result);
            cells[n].state = map.state(n);
        }
    }
    result.left_to_twin = map.left_to_twin();
    return result;
}

}  // namespace

std::vector<BatchCell> random_cells(unsigned seed, std::size_t count, double least_frequency,
                                    double largest_frequency, double least_gap, double largest_gap) {
    std::mt19937 random(seed);
    const auto between = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    std::vector<BatchCell> cells;
    for (std::size_t n = 0; n < count; ++n) {
        const double frequency = least_frequency * std::pow(largest_frequency / least_frequency, between(0, 1));
        double gap = between(least_gap, largest_gap);
        if (n % 5 == 0) gap = between(std::max(least_gap, -1.0), 0.3);
        if (n % 7 == 0) gap = 0;
        scene::State<double> state(between(-4, 0.5), between(-4, 4));
        if (n % 9 == 0) state[0] = between(0, 0.01);  // near the stop: pressed or just let go
        if (n % 31 == 0) state[0] = 0;
        cells.push_back({frequency, gap, state});
    }
    return cells;
}

Comparison compare_with_twin(const scene::Oscillator<double>& rig, std::vector<BatchCell> cells,
                             const BatchGrid& grid, int cycles) {
    batch::BatchedCycleMap map(rig, cells.size(), grid.steps_per_cycle, grid.springs);
    std::vector<Twin> twins;
    for (std::size_t n = 0; n < cells.size(); ++n) {
        map.add(cells[n].frequency, cells[n].gap, cells[n].state);
        scene::Oscillator<double> oscillator = rig;
        oscillator.frequency = cells[n].frequency;
        oscillator.gap = cells[n].gap;
        twins.push_back(twin_of(oscillator, grid));
    }
    return compare_cycles(map, twins, cells, cycles);
}

Comparison compare_with_twin(std::vector<OwnRigCell> cells, const BatchGrid& grid, int cycles) {
    const bool rigid = scene::is_rigid(cells.front().oscillator.contact);
    batch::BatchedCycleMap map(cells.size(), grid.steps_per_cycle, grid.springs,
                               rigid ? batch::Stop::rigid : batch::Stop::spring_dashpot);
    std::vector<Twin> twins;
    for (const OwnRigCell& cell : cells) {
        map.add(cell.oscillator, cell.state);
        twins.push_back(twin_of(cell.oscillator, grid));
    }
    return compare_cycles(map, twins, cells, cycles);
}

}  // namespace peterka::testing
