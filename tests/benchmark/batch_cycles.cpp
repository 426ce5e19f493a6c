// Time per forcing cycle and cell, and error in peak force, of the batched engine, with force and Jacobian, and
// of the scalar ones.
//
// Eight regular cells of the 170 mm rig, 200 cycles from rest; the batched engine carries 256 copies of each,
// shuffled, in one batch. Engines take turns and the fastest of their rounds counts, so that other
// work on the machine disturbs as little as possible. The error is that of the peak force of the last ten
// cycles against the scalar twin in long double; with a rigid stop, of the impact speed, on as many cells of
// its own. There the closed form of 1/n tells the error, too. The split engines have the paper's cubic spring,
// and the kicks per cycle that each cell needs for 1e-9; the batched one takes the copies of one cell at a
// time, and the truth has eight times the kicks.
//   build/tests/batch_cycles [ROUNDS]
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "../unit/batch_cases.hpp"
#include "batch/cycle_kernel.hpp"
#include "integrators/integrated_cycle_map.hpp"
#include "trajectory/exact_cycle_map.hpp"
#include "trajectory/recorder.hpp"
#include "trajectory/split_cycle_map.hpp"

namespace {

using namespace peterka;
using testing::regular_cells;
constexpr int cycles = 200;
constexpr int last_cycles = 10;
constexpr std::size_t copies = 256;
constexpr std::size_t slots = 2048;
constexpr std::size_t kinds = std::size(regular_cells);
constexpr double lowest_frequency = 0.8;
constexpr double paper_cubic = 0.89e-3 * 0.89e-3;  // the spring's k (x + x^3) in metres, over k A0
constexpr double split_reach = 7;                  // |u| stays below

using Peaks = std::array<double, kinds>;

scene::Oscillator<double> oscillator_of(std::size_t kind) {
    return testing::paper_rig(testing::beam_170mm, regular_cells[kind][0], regular_cells[kind][1]);
}

// The same hammer on a rigid stop, and cells where it moves regularly there.
constexpr double regular_on_rigid[kinds][2] = {{2.0, 0.0}, {1.3, 1.0}, {1.1, 4.0}, {3.5, 0.3},
                                               {2.75, 0},  {0.8, 0.2}, {3.1, 0.0}, {4.2, 0.5}};
scene::Oscillator<double> rigid_oscillator_of(std::size_t kind) {
    auto oscillator =
        testing::paper_rig(testing::beam_170mm, regular_on_rigid[kind][0], regular_on_rigid[kind][1]);
    oscillator.contact = scene::Restitution<double>{0.32};
    return oscillator;
}

scene::Oscillator<double> cubic_oscillator_of(std::size_t kind) {
    return testing::cubic_rig(paper_cubic, regular_cells[kind][0], regular_cells[kind][1]);
}

int kicks_of(const scene::Oscillator<double>& oscillator) {
    return trajectory::split_steps(oscillator, split_reach, 1e-9);
}

template <class Real>
scene::Oscillator<Real> in(const scene::Oscillator<double>& oscillator) {
    return {.damping_ratio = oscillator.damping_ratio,
            .contact =
                std::visit([](const auto& stop) -> scene::ContactLaw<Real> { return stop.template as<Real>(); },
                           oscillator.contact),
            .frequency = oscillator.frequency,
            .gap = oscillator.gap,
            .cubic = oscillator.cubic};
}

// The peak force, or the impact speed where there is none.
double told(const auto& totals) {
    return static_cast<double>(totals.struck_rigid_stop ? totals.impact_speed : totals.largest_force);
}

// That of the last cycles, from rest; `measured`: all cycles are.
template <class Real, class Map>
double peak_of(Map map, const scene::State<double>& start, int length, bool measured) {
    scene::State<Real> x = start.cast<Real>();
    trajectory::Recorder<Real> recorder;
    for (int cycle = 0; cycle < length; ++cycle) {
        const bool last = cycle >= length - last_cycles;
        if (cycle == length - last_cycles) recorder.reset_totals();
        x = map(x, last || measured ? &recorder : nullptr).end;
    }
    return told(recorder.totals());
}

using OfKind = scene::Oscillator<double> (*)(std::size_t);

template <class Real, class MakeMap>
Peaks scalar_peaks(int length, bool measured, const MakeMap& make_map, OfKind of_kind = oscillator_of) {
    Peaks peaks{};
    for (std::size_t kind = 0; kind < kinds; ++kind) {
        const auto oscillator = of_kind(kind);
        peaks[kind] = peak_of<Real>(make_map(oscillator), testing::start_at(oscillator), length, measured);
    }
    return peaks;
}

template <class Real>
Peaks split_peaks(int refined, bool measured) {
    Peaks peaks{};
    for (std::size_t kind = 0; kind < kinds; ++kind) {
        const auto oscillator = cubic_oscillator_of(kind);
        const trajectory::SplitCycleMap<Real> map(in<Real>(oscillator), refined * kicks_of(oscillator));
        peaks[kind] = peak_of<Real>(map, testing::start_at(oscillator), cycles, measured);
    }
    return peaks;
}

struct Batch {
    Peaks peaks{};
    double left_to_twin = 0;
};

Batch batch_peaks(OfKind of_kind = oscillator_of) {
    std::vector<std::size_t> order(kinds * copies);
    for (std::size_t n = 0; n < order.size(); ++n) order[n] = n % kinds;
    std::shuffle(order.begin(), order.end(), std::mt19937(1));
    Batch result;
    for (std::size_t first = 0; first < order.size(); first += slots) {
        batch::BatchedCycleMap map(of_kind(0), slots, batch::BatchedCycleMap::steps_for(lowest_frequency));
        for (std::size_t slot = 0; slot < slots; ++slot) {
            const auto oscillator = of_kind(order[first + slot]);
            map.add(oscillator.frequency, oscillator.gap, testing::start_at(oscillator));
        }
        for (int cycle = 0; cycle < cycles; ++cycle) {
            const bool last = cycle >= cycles - last_cycles;
            map.advance();
            if (!last) continue;
            for (std::size_t slot = 0; slot < slots; ++slot) {
                double& peak = result.peaks[order[first + slot]];
                peak = std::max(peak, told(map.totals(slot)));
            }
        }
        result.left_to_twin +=
            static_cast<double>(map.left_to_twin()) / static_cast<double>(order.size() * cycles);
    }
    return result;
}

Batch split_batch_peaks() {
    Batch result;
    for (std::size_t kind = 0; kind < kinds; ++kind) {
        const auto oscillator = cubic_oscillator_of(kind);
        batch::BatchedCycleMap map(oscillator, copies, kicks_of(oscillator), batch::Springs::split);
        for (std::size_t slot = 0; slot < copies; ++slot) {
            map.add(oscillator.frequency, oscillator.gap, testing::start_at(oscillator));
        }
        for (int cycle = 0; cycle < cycles; ++cycle) {
            const bool last = cycle >= cycles - last_cycles;
            map.advance();
            if (last) result.peaks[kind] = std::max(result.peaks[kind], map.peak_force(0));
        }
        result.left_to_twin +=
            static_cast<double>(map.left_to_twin()) / static_cast<double>(kinds * copies * cycles);
    }
    return result;
}

// Orbits 1/n of r = 0.6, zeta = 0.02 in closed form (eta, gap, their impact speed), and how far the batch is
// off.
double off_closed_form() {
    constexpr double orbits[][3] = {
        {2, 0, 11.841323894932}, {2, 0.5, 10.966655235621}, {4, 0, 18.951633786639}};
    double error = 0;
    for (const auto& [frequency, gap, speed] : orbits) {
        const scene::Oscillator<double> oscillator{.damping_ratio = 0.02,
                                                   .contact = scene::Restitution<double>{0.6},
                                                   .frequency = frequency,
                                                   .gap = gap};
        batch::BatchedCycleMap map(oscillator, 1);
        map.add(frequency, gap, {-1 - gap, 0});
        double largest = 0;
        for (int cycle = 0; cycle < 10 * cycles; ++cycle) {
            map.advance();
            if (cycle >= 10 * cycles - last_cycles) largest = std::max(largest, map.totals(0).impact_speed);
        }
        error = std::max(error, std::abs(largest / speed - 1));
    }
    return error;
}

enum class Truth : std::uint8_t { exact, early, split, rigid };

struct Contestant {
    std::string name;
    double cell_cycles;
    std::function<Peaks()> run;
    Truth truth = Truth::exact;
    Peaks peaks{};
    double best = std::numeric_limits<double>::infinity();  // microseconds per cycle and cell
};

double largest_error(const Peaks& peaks, const Peaks& truth) {
    double error = 0;
    for (std::size_t n = 0; n < kinds; ++n) error = std::max(error, std::abs(peaks[n] / truth[n] - 1));
    return error;
}

std::vector<Contestant> contestants() {
    constexpr double all_cells = static_cast<double>(kinds * copies) * cycles;
    constexpr double scalar_cells = static_cast<double>(kinds) * cycles;
    std::vector<Contestant> list;
    for (const std::int64_t set : batch::instruction_sets()) {
        const auto add = [&](std::string_view law, const std::function<Batch()>& run, Truth truth) {
            list.push_back({fmt::format("batch, {}{}", law, batch::name_of(set)), all_cells,
                            [set, run] {
                                batch::use_instruction_set(set);
                                return run().peaks;
                            },
                            truth});
        };
        add(
            "", [] { return batch_peaks(); }, Truth::exact);
        add(
            "rigid, ", [] { return batch_peaks(rigid_oscillator_of); }, Truth::rigid);
        add("split, ", split_batch_peaks, Truth::split);
    }
    const auto exact = [](const auto& oscillator) { return trajectory::ExactCycleMap<double>(oscillator); };
    list.push_back({"exact", scalar_cells, [=] { return scalar_peaks<double>(cycles, false, exact); }});
    list.push_back(
        {"exact + peak force", scalar_cells, [=] { return scalar_peaks<double>(cycles, true, exact); }});
    const auto rigid = [](const auto& oscillator) { return trajectory::RigidExactMap<double>(oscillator); };
    for (const bool measured : {false, true}) {
        list.push_back({measured ? "exact, rigid + impacts" : "exact, rigid", scalar_cells,
                        [=] { return scalar_peaks<double>(cycles, measured, rigid, rigid_oscillator_of); },
                        Truth::rigid});
    }
    list.push_back({"split", scalar_cells, [] { return split_peaks<double>(1, false); }, Truth::split});
    list.push_back(
        {"split + peak force", scalar_cells, [] { return split_peaks<double>(1, true); }, Truth::split});
    for (const auto& [name, integrator] : {std::pair{"cvode 1e-9", integrators::Integrator::cvode_adams},
                                           {"arkode 1e-9", integrators::Integrator::arkode_explicit}}) {
        // fewer cycles: their error is that after a shorter transient
        list.push_back({name, static_cast<double>(kinds) * 40,
                        [integrator = integrator] {
                            return scalar_peaks<double>(40, false, [=](const auto& oscillator) {
                                return integrators::IntegratedCycleMap(oscillator, integrator, 1e-9);
                            });
                        },
                        Truth::early});
    }
    return list;
}

}  // namespace

int main(int argc, char** argv) {
    const int rounds = argc > 1 ? std::stoi(argv[1]) : 5;
    const auto precise = [](const auto& oscillator) {
        return trajectory::ExactCycleMap<long double>(in<long double>(oscillator));
    };
    const auto precise_rigid = [](const auto& oscillator) {
        return trajectory::RigidExactMap<long double>(in<long double>(oscillator));
    };
    const std::map<Truth, Peaks> truth{
        {Truth::exact, scalar_peaks<long double>(cycles, false, precise)},
        {Truth::early, scalar_peaks<long double>(40, false, precise)},
        {Truth::split, split_peaks<long double>(8, false)},
        {Truth::rigid, scalar_peaks<long double>(cycles, false, precise_rigid, rigid_oscillator_of)}};

    auto list = contestants();
    for (int round = 0; round < rounds; ++round) {
        for (Contestant& one : list) {
            const auto start = std::chrono::steady_clock::now();
            one.peaks = one.run();
            const std::chrono::duration<double, std::micro> time = std::chrono::steady_clock::now() - start;
            one.best = std::min(one.best, time.count() / one.cell_cycles);
        }
    }
    batch::use_instruction_set(0);
    const auto exact =
        std::find_if(list.begin(), list.end(), [](const Contestant& c) { return c.name == "exact"; });
    fmt::print("{:<32}{:>14}{:>14}{:>14}\n", "engine", "us/cycle", "error", "exact/this");
    for (const Contestant& one : list) {
        fmt::print("{:<32}{:>14.4f}{:>14.1e}{:>14.1f}\n", one.name, one.best,
                   largest_error(one.peaks, truth.at(one.truth)), exact->best / one.best);
    }
    fmt::print("kicks per cycle of the split engines:");
    for (std::size_t kind = 0; kind < kinds; ++kind) fmt::print(" {}", kicks_of(cubic_oscillator_of(kind)));
    fmt::print(
        "\nleft to the scalar twin: {:.2g} of the cycles, {:.2g} with split springs, {:.2g} with a rigid "
        "stop\n",
        batch_peaks().left_to_twin, split_batch_peaks().left_to_twin,
        batch_peaks(rigid_oscillator_of).left_to_twin);
    fmt::print("rigid stop, batch against the closed form of 1/1 and 1/2: {:.1e} of the impact speed\n",
               off_closed_form());
}
