// Time per forcing cycle and cell, and error in peak force, of the batched engine and of the scalar ones.
//
// Eight regular cells of the 170 mm rig, 200 cycles from rest; the batched engine carries 256 copies of each,
// shuffled, in one batch. Engines take turns and the fastest of their rounds counts, so that other
// work on the machine disturbs as little as possible. The error is that of the peak force of the last ten
// cycles against the scalar twin in long double.
//   build/tests/batch_cycles [ROUNDS]
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "../unit/batch_cases.hpp"
#include "batch/cycle_kernel.hpp"
#include "trajectory/integrated_cycle_map.hpp"
#include "trajectory/recorder.hpp"

namespace {

using namespace peterka;
using testing::regular_cells;
constexpr int cycles = 200;
constexpr int last_cycles = 10;
constexpr std::size_t copies = 256;
constexpr std::size_t slots = 2048;
constexpr std::size_t kinds = std::size(regular_cells);
constexpr double lowest_frequency = 0.8;

using Peaks = std::array<double, kinds>;

scene::Oscillator<double> scene_of(std::size_t kind) {
    return testing::paper_rig(testing::beam_170mm, regular_cells[kind][0], regular_cells[kind][1]);
}

template <class Real>
scene::Oscillator<Real> in(const scene::Oscillator<double>& scene) {
    return {.damping_ratio = scene.damping_ratio,
            .contact = scene::KelvinVoigt<Real>{scene.kelvin_voigt().stiffness, scene.kelvin_voigt().damping},
            .frequency = scene.frequency,
            .gap = scene.gap};
}

// Peak force of the last cycles, from rest; `measured`: all cycles are.
template <class Real, class Map>
double peak_of(Map map, const scene::State<double>& start, int length, bool measured) {
    scene::State<Real> x = start.cast<Real>();
    trajectory::Recorder<Real> recorder;
    for (int cycle = 0; cycle < length; ++cycle) {
        const bool last = cycle >= length - last_cycles;
        if (cycle == length - last_cycles) recorder.reset_totals();
        x = map(x, last || measured ? &recorder : nullptr).end;
    }
    return static_cast<double>(recorder.totals().largest_force);
}

template <class Real, class MakeMap>
Peaks scalar_peaks(int length, bool measured, const MakeMap& make_map) {
    Peaks peaks{};
    for (std::size_t kind = 0; kind < kinds; ++kind) {
        const auto scene = scene_of(kind);
        peaks[kind] = peak_of<Real>(make_map(scene), testing::start_at(scene), length, measured);
    }
    return peaks;
}

struct Batch {
    Peaks peaks{};
    double left_to_twin = 0;
};

Batch batch_peaks(batch::Wanted wanted) {
    std::vector<std::size_t> order(kinds * copies);
    for (std::size_t n = 0; n < order.size(); ++n) order[n] = n % kinds;
    std::shuffle(order.begin(), order.end(), std::mt19937(1));
    Batch result;
    for (std::size_t first = 0; first < order.size(); first += slots) {
        batch::BatchedCycleMap map(scene_of(0), slots, batch::BatchedCycleMap::steps_for(lowest_frequency));
        for (std::size_t slot = 0; slot < slots; ++slot) {
            const auto scene = scene_of(order[first + slot]);
            map.add(scene.frequency, scene.gap, testing::start_at(scene));
        }
        for (int cycle = 0; cycle < cycles; ++cycle) {
            const bool last = cycle >= cycles - last_cycles;
            map.advance({wanted.measure || last, wanted.jacobian});
            if (!last) continue;
            for (std::size_t slot = 0; slot < slots; ++slot) {
                double& peak = result.peaks[order[first + slot]];
                peak = std::max(peak, map.peak_force(slot));
            }
        }
        result.left_to_twin +=
            static_cast<double>(map.left_to_twin()) / static_cast<double>(order.size() * cycles);
    }
    return result;
}

struct Contestant {
    std::string name;
    double cell_cycles;
    std::function<Peaks()> run;
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
        for (const auto& [what, wanted] : {std::pair{"", batch::Wanted{}},
                                           {" + peak force", batch::Wanted{true, false}},
                                           {" + Jacobian", batch::Wanted{false, true}},
                                           {" + both", batch::Wanted{true, true}}}) {
            list.push_back(
                {fmt::format("batch, {}{}", batch::name_of(set), what), all_cells, [set, wanted = wanted] {
                     batch::use_instruction_set(set);
                     return batch_peaks(wanted).peaks;
                 }});
        }
    }
    const auto exact = [](const auto& scene) { return trajectory::ExactCycleMap<double>(scene); };
    list.push_back({"exact", scalar_cells, [=] { return scalar_peaks<double>(cycles, false, exact); }});
    list.push_back(
        {"exact + peak force", scalar_cells, [=] { return scalar_peaks<double>(cycles, true, exact); }});
    for (const auto& [name, integrator] : {std::pair{"cvode 1e-9", trajectory::Integrator::cvode_adams},
                                           {"arkode 1e-9", trajectory::Integrator::arkode_explicit}}) {
        // fewer cycles: their error is that after a shorter transient
        list.push_back({name, static_cast<double>(kinds) * 40, [integrator = integrator] {
                            return scalar_peaks<double>(40, false, [=](const auto& scene) {
                                return trajectory::IntegratedCycleMap(scene, integrator, 1e-9);
                            });
                        }});
    }
    return list;
}

}  // namespace

int main(int argc, char** argv) {
    const int rounds = argc > 1 ? std::stoi(argv[1]) : 5;
    const auto precise = [](const auto& scene) {
        return trajectory::ExactCycleMap<long double>(in<long double>(scene));
    };
    const Peaks truth = scalar_peaks<long double>(cycles, false, precise);
    const Peaks early_truth = scalar_peaks<long double>(40, false, precise);

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
        const bool is_short = one.cell_cycles == static_cast<double>(kinds) * 40;
        fmt::print("{:<32}{:>14.4f}{:>14.1e}{:>14.1f}\n", one.name, one.best,
                   largest_error(one.peaks, is_short ? early_truth : truth), exact->best / one.best);
    }
    fmt::print("left to the scalar twin: {:.2g} of the cycles\n", batch_peaks({}).left_to_twin);
}
