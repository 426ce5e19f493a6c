// Attacks critical kicks: for periodic attractors of random rigs, random kicks smaller than the one that is
// told, at random phases, each followed by a run of its own that knows no attractor.
//
// Rigs are random in loss, stop (spring and dashpot, some of them soft, and rigid ones), frequency and gap; of
// each cell every periodic attractor that 16 starts find is taken. Where no critical kick is told, kicks are as
// large as those tried. Kicks that were still on chaos when they were no longer followed don't count where
// those that came back from it show that they would have come back, too.
//   build/tests/critical_kicks [ATTRACTORS] [KICKS_EACH] [SEED]
//   build/tests/critical_kicks plane RIG SLOT POINTS SEED FILE   where kicks of one orbit end, over phase and
//   size
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <numeric>
#include <random>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "attractors/multi_start_pool.hpp"
#include "job/read.hpp"
#include "regime/same_attractor.hpp"
#include "regime/search_pool.hpp"
#include "regime/solve_cell.hpp"
#include "scene/scene.hpp"
#include "trajectory/exact_cycle_map.hpp"

namespace {

using namespace peterka;
using attractors::CellAttractor;

class Random {
  public:
    explicit Random(std::uint64_t seed) : engine_(seed) {}
    double between(double from, double to) {
        return from + (to - from) * static_cast<double>(engine_() >> 11U) * 0x1p-53;
    }
    double log_between(double from, double to) { return std::exp(between(std::log(from), std::log(to))); }

  private:
    std::mt19937_64 engine_;
};

job::Job random_job(Random& random, bool kicks) {
    const bool rigid = random.between(0, 1) < 0.25;
    const std::string stop =
        rigid ? fmt::format("law = \"restitution\"\ncoefficient = {}", random.between(0.3, 0.9))
              : fmt::format("law = \"kelvin_voigt\"\nstiffness_n_per_m = {}\ndamping_ns_per_m = {}",
                            random.log_between(3e4, 1e7), random.log_between(30, 2000));
    const double zeta = random.log_between(0.003, 0.05);
    const double frequency = random.between(0.6, 4.4);
    const double gap = random.between(rigid ? 0.0 : -0.2, 3.5);
    const std::string text = fmt::format(
        "schema = 1\nkind = \"map\"\n[hammer]\nmass_kg = 0.298\nnatural_frequency_hz = 4.5\n"
        "damping_ratio = {}\n[cart]\namplitude_m = 0.89e-3\n[contact]\n{}\n"
        "[axes.frequency_ratio]\nfrom = {}\nto = {}\npoints = 1\n"
        "[axes.gap_ratio]\nfrom = {}\nto = {}\npoints = 1\n[starts]\ncount = 16\n{}",
        zeta, stop, frequency, frequency, gap, gap, kicks ? "[output]\nfields = [\"critical_kick\"]\n" : "");
    return job::read_job_text(text, "random rig");
}

attractors::SolvedCell solve(const scene::Scene& scene) {
    attractors::SolvedCell solved;
    const regime::AttractorTable none;
    attractors::MultiStartPool pool(scene, none, [&](auto& cell) { solved = std::move(cell.cell); });
    pool.add(0, 0, 0);
    while (!pool.empty()) pool.step();
    return solved;
}

regime::CellResult as_result(const CellAttractor& attractor) {
    regime::CellResult result;
    result.regime = attractor.regime;
    result.impacts = attractor.impacts;
    result.period = attractor.period;
    result.orbit_displacement = attractor.orbit_displacement;
    result.orbit_velocity = attractor.orbit_velocity;
    return result;
}

// The state at the next forcing phase 0.
template <class Map>
scene::State<double> kicked(const Map& map, const CellAttractor& attractor, double phase, double change) {
    const auto& oscillator = map.oscillator();
    scene::State<double> state(attractor.orbit_displacement - oscillator.gap, attractor.orbit_velocity);
    for (; phase >= 1; --phase) state = map(state).end;
    const double moment = phase * oscillator.period();
    state = map.part(state, 0, moment).end;
    state[1] += change;
    return map.part(state, moment, oscillator.period()).end;
}

// Kicks that end elsewhere.
struct Leave {
    std::int64_t count = 0;
    double smallest = std::numeric_limits<double>::infinity();  // of these, over the size told
    double phase = 0;

    void add(double size, double at) {
        ++count;
        if (size >= smallest) return;
        smallest = size;
        phase = at;
    }
    void add(const Leave& other) {
        count += other.count;
        if (other.smallest >= smallest) return;
        smallest = other.smallest;
        phase = other.phase;
    }
};

// Lives of the kicks that were seen to come back from chaos, after they had forgotten their start [cycles].
using Lives = std::vector<std::int64_t>;

// Whether those that came back say that as many as stayed on chaos would stay for as long, with lives that are
// spread exponentially: then they only weren't followed to their ends.
bool is_chance(std::int64_t stayed, std::int64_t shortest_stay, const Lives& lives) {
    if (lives.empty()) return false;
    const auto count = static_cast<double>(lives.size());
    const double mean = std::accumulate(lives.begin(), lives.end(), 0.0) / count;
    return static_cast<double>(stayed) <= 5 * count * std::exp(-static_cast<double>(shortest_stay) / mean);
}

struct KickAt {
    double phase;   // forcing cycles after phase 0 of the orbit's first point
    double change;  // of the velocity, in A0 omega
};

double most_of(const CellAttractor& attractor) {
    return std::isnan(attractor.kick.size) ? attractor.kick.tried : attractor.kick.size;
}

// Runs of their own, that know no attractor, after each of so many kicks: what they end on goes to take(n,
// result).
template <class KickOf, class Take>
void follow(const scene::Scene& scene, const CellAttractor& attractor, std::int64_t kicks,
            const KickOf& kick_of, const Take& take) {
    const scene::Cell cell = scene.cell(0, 0);
    job::Job job = scene.job();
    job.output.fields.clear();
    const regime::AttractorTable none;
    regime::SearchPool pool(scene, none, [&](const regime::SearchPool::NumberedOutcome& solved) {
        take(solved.number, solved.outcome.result);
    });
    const auto start_of = [&](const KickAt& kick) {
        if (scene::is_rigid(cell.oscillator.contact)) {
            return kicked(trajectory::RigidExactMap<double>(cell.oscillator), attractor, kick.phase,
                          kick.change);
        }
        return kicked(trajectory::ExactCycleMap<double>(cell.oscillator), attractor, kick.phase, kick.change);
    };
    for (std::int64_t n = 0; n < kicks || !pool.empty();) {
        while (n < kicks && pool.has_room()) {
            const scene::State<double> start = start_of(kick_of(n));
            pool.add(
                [&job, &cell, start](regime::CycleBroker& broker) {
                    return regime::outcome_of(regime::solve_cell(broker, job, {cell.oscillator, start}));
                },
                n++);
        }
        if (!pool.empty()) pool.step();
    }
}

// Cycles after a run had forgotten its start.
std::int64_t chaotic_cycles(const regime::CellResult& ended) {
    return ended.forgot_after > 0 ? ended.followed_cycles - ended.forgot_after : 0;
}

bool is_on_chaos(const regime::CellResult& ended) {
    using enum regime::Regime;
    return ended.regime == chaotic || (ended.regime == unresolved && chaotic_cycles(ended) > 0);
}

// As the program has it: an engine that gave up, or a budget that ran out on the way.
bool is_unknown(const regime::CellResult& ended) {
    using enum regime::Regime;
    return ended.regime == failed || (ended.regime == unresolved && chaotic_cycles(ended) == 0);
}

// Kicks up to `most` [A0 omega], at random.
Leave attack(const scene::Scene& scene, const CellAttractor& attractor, double most, std::int64_t kicks,
             Random& random) {
    const regime::CellResult settled = as_result(attractor);
    std::vector<KickAt> tried;
    Leave found;
    Leave on_chaos;
    Lives lives;
    std::int64_t shortest_stay = std::numeric_limits<std::int64_t>::max();
    const auto kick_of = [&](std::int64_t) {
        const double phase = random.between(0, attractor.period);
        return tried.emplace_back(KickAt{phase, random.between(-most, most)});
    };
    follow(scene, attractor, kicks, kick_of, [&](std::int64_t number, const regime::CellResult& ended) {
        if (is_unknown(ended)) return;
        if (regime::same_attractor(settled, ended)) {
            if (chaotic_cycles(ended) > 0) lives.push_back(chaotic_cycles(ended));
            return;
        }
        const KickAt& kick = tried[static_cast<std::size_t>(number)];
        (is_on_chaos(ended) ? on_chaos : found).add(std::abs(kick.change) / most, kick.phase);
        if (is_on_chaos(ended)) shortest_stay = std::min(shortest_stay, chaotic_cycles(ended));
    });
    if (!is_chance(on_chaos.count, shortest_stay, lives)) found.add(on_chaos);
    return found;
}

// Lines "phase change end cycles": change [A0 omega]; end 0 back, 1 elsewhere, 2 on chaos, 3 unknown.
int write_plane(std::uint64_t seed, std::uint64_t rig, std::size_t slot, int points, const char* path) {
    Random of_rig(seed * 1'000'003 + rig);
    const scene::Scene scene(random_job(of_rig, true));
    const attractors::SolvedCell solved = solve(scene);
    const CellAttractor& attractor = solved.attractors.at(slot);
    const regime::CellResult settled = as_result(attractor);
    const double most = 1.1 * most_of(attractor);
    const auto kick_of = [&](std::int64_t n) {
        const auto middle = [&](std::int64_t i) { return (static_cast<double>(i) + 0.5) / points; };
        return KickAt{attractor.period * middle(n % points), most * (2 * middle(n / points) - 1)};
    };
    std::FILE* file = std::fopen(path, "w");
    if (file == nullptr) return EXIT_FAILURE;
    follow(scene, attractor, std::int64_t{points} * points, kick_of,
           [&](std::int64_t number, const regime::CellResult& ended) {
               const bool is_back = regime::same_attractor(settled, ended);
               fmt::print(file, "{} {} {} {}\n", kick_of(number).phase, kick_of(number).change,
                          is_back ? 0 : (is_unknown(ended) ? 3 : (is_on_chaos(ended) ? 2 : 1)), ended.cycles);
           });
    return std::fclose(file) == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace

int main(int argc, char** argv) {
    const auto number = [argv](int n) { return std::strtoull(argv[n], nullptr, 10); };
    if (argc == 7 && std::string_view(argv[1]) == "plane")
        return write_plane(number(5), number(2), number(3), static_cast<int>(number(4)), argv[6]);
    const std::int64_t wanted = argc > 1 ? std::atoll(argv[1]) : 100;
    const std::int64_t kicks = argc > 2 ? std::atoll(argv[2]) : 10'000;
    const std::uint64_t seed = argc > 3 ? number(3) : 1;
    Random random(seed);
    std::int64_t attractors = 0;
    std::int64_t without = 0;
    std::int64_t broken = 0;
    std::int64_t by_a_tenth = 0;
    std::int64_t broken_bounds = 0;
    std::vector<double> bounds;  // over the kicks told
    std::int64_t cycles = 0;
    double seconds = 0;
    const auto now = [] { return std::chrono::steady_clock::now(); };
    for (std::uint64_t rig = 0; attractors < wanted; ++rig) {
        Random of_rig(seed * 1'000'003 + rig);
        Random same = of_rig;
        const scene::Scene scene(random_job(of_rig, true));
        const auto begin = now();
        const attractors::SolvedCell solved = solve(scene);
        seconds += std::chrono::duration<double>(now() - begin).count();
        bool counted = false;
        for (const CellAttractor& attractor : solved.attractors) {
            if (attractor.regime != regime::Regime::periodic || attractors == wanted) continue;
            if (!std::exchange(counted, true)) {
                cycles += solved.cell.cycles - solve(scene::Scene(random_job(same, false))).cell.cycles;
            }
            ++attractors;
            const bool none = std::isnan(attractor.kick.size);
            without += none ? 1 : 0;
            const Leave found = attack(scene, attractor, most_of(attractor), kicks, random);
            broken += found.count > 0 ? 1 : 0;
            by_a_tenth += found.smallest < 0.9 ? 1 : 0;
            if (!std::isnan(attractor.kick.lower)) {
                const Leave below = attack(scene, attractor, attractor.kick.lower, kicks, random);
                broken_bounds += below.count > 0 ? 1 : 0;
                bounds.push_back(attractor.kick.lower / most_of(attractor));
            }
            fmt::print("rig {} slot {} {}/{} kick {:.4g} phase {:.4f} direction {} tried {:.4g} lower {:.4g}",
                       rig, &attractor - solved.attractors.data(), attractor.impacts, attractor.period,
                       attractor.kick.size, attractor.kick.phase, static_cast<int>(attractor.kick.direction),
                       attractor.kick.tried, attractor.kick.lower);
            if (found.count > 0) {
                fmt::print("  BROKEN by {} of {}, least {:.4f} of it at phase {:.4f}", found.count, kicks,
                           found.smallest, found.phase);
            }
            fmt::print("\n");
            std::fflush(stdout);
        }
    }
    std::ranges::sort(bounds);
    fmt::print(
        "{} have a lower bound, median {:.3g} of their kick; {} of these have a smaller kick that leads "
        "elsewhere\n",
        bounds.size(), bounds.empty() ? 0.0 : bounds[bounds.size() / 2], broken_bounds);
    fmt::print(
        "{} attractors, {} of them without a critical kick; {} kicks each: {} have a smaller one, {} by more "
        "than a tenth\n{:.3g} cycles an attractor for the kicks, {:.3g} ms with all that goes with it\n",
        attractors, without, kicks, broken, by_a_tenth,
        static_cast<double>(cycles) / static_cast<double>(attractors),
        1e3 * seconds / static_cast<double>(attractors));
    return EXIT_SUCCESS;
}
