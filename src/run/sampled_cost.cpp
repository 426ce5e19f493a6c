#include "run/sampled_cost.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <functional>
#include <numeric>
#include <span>
#include <vector>

#include "attractors/along_branch.hpp"
#include "job/axis.hpp"
#include "job/branches.hpp"
#include "parallel/listed_tiles.hpp"
#include "regime/branch.hpp"
#include "regime/engine.hpp"
#include "run/audit_sample.hpp"
#include "run/known_attractors.hpp"
#include "run/mean_lives.hpp"
#include "run/solve_tiles.hpp"
#include "scene/scene.hpp"

namespace peterka {
namespace {

// Of this process, whatever else the machine does [s].
double processor_time() {
    return static_cast<double>(std::clock()) / static_cast<double>(CLOCKS_PER_SEC);
}

bool only_integrators(const scene::Scene& scene) {
    return regime::has_nonlinear_contact(scene.cell(0, 0).oscillator);
}

bool asks_for_integrator(const job::Job& job) {
    return job.solver.engine == job::EngineChoice::cvode || job.solver.engine == job::EngineChoice::arkode;
}

// The job whose cells are counted: a law with a closed form has the same labels, and so the same cycles,
// whichever engine is asked for. Cells are given up where a sample would take minutes.
job::Job counted_job(job::Job job, bool integrates) {
    constexpr std::int64_t most_cycles = 10'000;
    constexpr std::int64_t most_integrated = 2000;
    if (!integrates && asks_for_integrator(job)) job.solver.engine = job::EngineChoice::automatic;
    const std::int64_t most =
        integrates ? std::min(most_integrated, job.steady_state.chaos_cycles) : most_cycles;
    job.steady_state.max_cycles = std::min(job.steady_state.max_cycles, most);
    job.certificate.cells = 0;
    job.noise = {};
    std::erase(job.output.fields, job::OptionalField::critical_kick);
    if (job.kind == job::Kind::curves) job.kind = job::Kind::map;  // its coarse map
    job.refine.levels = 0;
    const std::int64_t most_tries = integrates ? 8 : 128;
    job.starts.count = std::min(job.starts.count, most_tries);
    job.uncertainty.rigs = std::min(job.uncertainty.rigs, most_tries);
    return job;
}

// Of a job over the counted one: a start and a drawn rig take about the same.
double tries_left_out(const job::Job& job, const job::Job& counted) {
    const auto tries = [](const job::Job& of) {
        return static_cast<double>(1 + of.starts.count + of.uncertainty.rigs);
    };
    return tries(job) / tries(counted);
}

struct Sample {
    std::vector<parallel::CellIndex> cells;
    std::vector<double> cycles;  // of each
    double seconds = 0;
    double unseen = 0;  // cycles that cells given up here may take in the job, all together
};

// given_up: cycles by which the job follows a cell for longer than the sample does.
void take(Sample& sample, const cell::CellResult& cell, std::int64_t given_up) {
    sample.cycles.push_back(cell.cycles);
    if (cell.regime == cell::Regime::unresolved) sample.unseen += static_cast<double>(given_up);
}

double sum(std::span<const double> values) {
    return std::accumulate(values.begin(), values.end(), 0.0);
}

double mean(std::span<const double> values) {
    return values.empty() ? 0 : sum(values) / static_cast<double>(values.size());
}

// Adds the cells of these stretches to a sample: one at random of each of `size` equal stretches.
void solve_sample(Sample& sample, const scene::Scene& scene, const regime::AttractorTable& known,
                  std::span<const std::int64_t> stretches, std::int64_t size, std::int64_t max_cycles) {
    std::vector<parallel::Tile> tiles;
    for (const std::int64_t n : stretches) {
        const std::int64_t cell = audited_cell(n, size, scene.job().cells());
        const parallel::CellIndex index{cell / scene.columns(), cell % scene.columns()};
        sample.cells.push_back(index);
        tiles.push_back({std::ssize(sample.cells) - 1, index.row, index.column, {1, 1}});
    }
    sample.cycles.resize(sample.cells.size());
    const TileWork work{
        .begin =
            [](const parallel::Tile& tile) {
                return std::vector<parallel::CellIndex>{{tile.row, tile.column}};
            },
        .go_on =
            [&](const parallel::Tile& tile, std::span<const attractors::SolvedCell> solved, double) {
                const cell::CellResult& cell = solved.front().cell;
                sample.cycles[static_cast<std::size_t>(tile.index)] = cell.cycles;
                if (cell.regime == cell::Regime::unresolved)
                    sample.unseen += static_cast<double>(max_cycles - scene.job().steady_state.max_cycles);
                return std::vector<parallel::CellIndex>();
            }};
    parallel::ListedTiles source(std::move(tiles));
    const double begin = processor_time();
    solve_tiles(scene, known, work, source);
    sample.seconds += processor_time() - begin;
}

// n-th of `size` places in an order that is spread over them at any time: steps by the golden section.
std::int64_t spread_place(std::int64_t n, std::int64_t size) {
    auto step = std::max<std::int64_t>(1, std::llround(0.618 * static_cast<double>(size)));
    while (std::gcd(step, size) != 1) ++step;
    return n * step % size;
}

// A few cells, so many side by side, until they have taken so long [s].
Sample solve_sample_for(double seconds, const scene::Scene& scene, const regime::AttractorTable& known,
                        std::int64_t size, std::int64_t together, std::int64_t max_cycles) {
    Sample sample;
    for (std::int64_t n = 0; n < size && sample.seconds < seconds; n += together) {
        std::vector<std::int64_t> places;
        for (std::int64_t i = n; i < std::min(n + together, size); ++i) places.push_back(spread_place(i, size));
        solve_sample(sample, scene, known, places, size, max_cycles);
    }
    return sample;
}

// Time of a cycle by an integrator [s], in cells of the sample that are chosen with probabilities in proportion
// to their cycles, so that the mean is that of all cycles. None if nothing has to be integrated.
std::vector<double> times_of_integrated_cycle(const scene::Scene& scene, const Sample& sample,
                                              const job::Solver& solver) {
    constexpr int cells = 12;
    constexpr int cycles = 8;
    constexpr double longest = 0.5;  // [s]
    const double all = sum(sample.cycles);
    std::vector<double> times;
    if (!(all > 0)) return times;
    const double begin = processor_time();
    double passed = 0;
    std::size_t at = 0;
    for (int n = 0; n < cells && processor_time() - begin < longest; ++n) {
        while (at + 1 < sample.cycles.size() && passed + sample.cycles[at] <= all * (n + 0.5) / cells) {
            passed += sample.cycles[at++];
        }
        const scene::Cell cell = scene.cell(sample.cells[at].row, sample.cells[at].column);
        const regime::Engine engine = solver.engine == job::EngineChoice::cvode ? regime::Engine::cvode
                                      : solver.engine == job::EngineChoice::arkode
                                          ? regime::Engine::arkode
                                          : regime::cheaper_integrator(cell.oscillator);
        auto map = regime::make_cycle_map(cell.oscillator, {.engine = engine, .tolerance = solver.tolerance});
        scene::State<double> state = cell.start;
        const double before = processor_time();
        for (int i = 0; i < cycles; ++i) state = std::visit([&](auto& each) { return each(state).end; }, map);
        times.push_back((processor_time() - before) / cycles);
    }
    return times;
}

// Of the mean, over it.
double relative_error(std::span<const double> values) {
    if (values.size() < 2) return 1;  // says nothing of others
    const double middle = mean(values);
    double squares = 0;
    for (const double value : values) squares += (value - middle) * (value - middle);
    const auto n = static_cast<double>(values.size());
    return middle > 0 ? std::sqrt(squares / (n * (n - 1))) / middle : 0;
}

// A part of a sweep: few neighbouring points.
job::Job part_of(job::Job sweep, std::int64_t first, std::int64_t points) {
    const job::Axis whole = sweep.columns;
    sweep.columns.from = job::axis_value(whole, first);
    sweep.columns.to = job::axis_value(whole, first + points - 1);
    sweep.columns.points = points;
    return sweep;
}

// Solves parts of a sweep here and there along its axis and on all its branches, and returns the time that each
// takes a point [s]. Ends when they have taken `longest` [s].
std::vector<double> times_of_parts(
    const job::Job& job, std::int64_t most_parts, std::int64_t points, double longest,
    const std::function<void(const scene::Scene& part, std::int64_t row)>& solve) {
    const std::int64_t parts = std::clamp<std::int64_t>(job.cells() / points, 1, most_parts);
    std::vector<double> seconds;
    const double start = processor_time();
    for (std::int64_t n = 0; n < parts && processor_time() - start < longest; ++n) {
        const std::int64_t first =
            spread_place(n, parts) * (job.columns.points - points) / std::max<std::int64_t>(parts - 1, 1);
        const scene::Scene part(part_of(job, first, points));
        const double begin = processor_time();
        solve(part, n % job.row_count());
        seconds.push_back((processor_time() - begin) / static_cast<double>(points));
    }
    return seconds;
}

// Walks along branches in stretches of `points`, in a large sweep with a few longer steps between them so that
// the motion is one that the branch is on, and returns the time that each stretch takes a point [s]. Ends after
// a branch when they have taken `longest` [s], or in one that takes four times as long.
std::vector<double> times_of_stretches(const scene::Scene& scene, std::int64_t most_stretches,
                                       std::int64_t points, double longest,
                                       const std::function<void(const cell::CellResult& cell)>& keep) {
    constexpr std::int64_t least_of_a_branch = 16;
    constexpr std::int64_t steps_between = 8;
    const auto look = [] {};
    const std::int64_t rows = scene.job().row_count();
    const std::int64_t fit = (scene.columns() + points - 1) / points;
    const std::int64_t of_a_branch = std::min(fit, std::max(most_stretches / rows, least_of_a_branch));
    std::vector<double> seconds;
    const double start = processor_time();
    const auto takes_longer_than = [&](double limit) { return processor_time() - start > limit; };
    for (std::int64_t n = 0; n < rows && std::ssize(seconds) < most_stretches && !takes_longer_than(longest);
         ++n) {
        const std::int64_t row = spread_place(n, rows);
        const std::vector<std::int64_t> columns = regime::columns_of(scene, row);
        regime::BranchWalk walk(scene, row);
        std::int64_t at = 0;  // in the order of the branch
        for (std::int64_t i = 0; i < of_a_branch && !takes_longer_than(4 * longest); ++i) {
            const std::int64_t end =
                points + i * (scene.columns() - points) / std::max<std::int64_t>(of_a_branch - 1, 1);
            const std::int64_t first = std::max(at, end - points);
            const std::int64_t stride = std::max<std::int64_t>((first - at) / steps_between, 1);
            const bool leaps = stride > 1;
            for (; at < first; at = std::min(at + stride, first))
                static_cast<void>(walk.to(columns[static_cast<std::size_t>(at)], look));
            // the first point after a longer step isn't one of the branch's
            if (leaps) static_cast<void>(walk.to(columns[static_cast<std::size_t>(at++)], look));
            const std::int64_t kept = end - at;
            const double begin = processor_time();
            for (; at < end; ++at) keep(walk.to(columns[static_cast<std::size_t>(at)], look).cell);
            if (kept > 0) seconds.push_back((processor_time() - begin) / static_cast<double>(kept));
        }
    }
    return seconds;
}

// Time of the lives of a cell of a map or a point of a sweep [s], from what a share of noise.cycles and a
// quarter of that take: motions that leave often end before their cycles do. counted: without noise.
double seconds_of_lives(const job::Job& counted, const job::Job& noisy, std::int64_t cell, double share) {
    const bool is_sweep = noisy.kind == job::Kind::sweep;
    const std::int64_t columns = counted.columns.points;
    std::int64_t row = cell / columns;
    double places = 1;  // that share these attractors
    std::vector<attractors::CellAttractor> kept;
    cell::CellResult own;
    if (is_sweep) {
        const scene::Scene part(part_of(counted, cell % columns, 1));
        const auto look = [] {};
        if (counted.starts.count > 0) {
            const std::int64_t of_gap = job::branches_of_a_gap(counted.sweep);
            row -= row % of_gap;
            places = static_cast<double>(of_gap);
            kept = attractors::find_along_branch(part, row, look).front().kept;
        } else {
            own = regime::follow_branch(part, row, look).front().cell;
        }
    } else {
        const scene::Scene scene(counted);
        const TileWork work{
            .begin =
                [](const parallel::Tile& tile) {
                    return std::vector<parallel::CellIndex>{{tile.row, tile.column}};
                },
            .go_on =
                [&](const parallel::Tile&, std::span<const attractors::SolvedCell> solved, double) {
                    own = solved.front().cell;
                    kept = solved.front().attractors;
                    return std::vector<parallel::CellIndex>();
                }};
        parallel::ListedTiles source({{0, row, cell % columns, {1, 1}}});
        solve_tiles(scene, regime::AttractorTable(), work, source);
    }
    const scene::Scene scene(noisy);
    const auto time_of = [&](double part) {
        const double begin = processor_time();
        add_mean_life(scene, row, cell % columns, own, part);
        for (attractors::CellAttractor& each : kept) add_mean_life(scene, row, cell % columns, each, part);
        return (processor_time() - begin) / places;
    };
    const double of_share = time_of(share);
    if (share == 1) return of_share;
    constexpr double part = 0.25;
    const double more = std::max(0.0, of_share - time_of(part * share)) / (share - part * share);
    return of_share + more * (1 - share);
}

// What is found from many starts or rigs serves all branches of a gap.
SampledCost cost_of_branches(const job::Job& asked, const job::Job& job, bool integrates) {
    const std::int64_t most_points = integrates ? 3 : 12;
    const std::int64_t points = std::min(most_points, job.columns.points);
    const auto look = [] {};
    const double begin = processor_time();
    Sample sample;
    const std::int64_t given_up = asked.steady_state.max_cycles - job.steady_state.max_cycles;
    const auto keep = [&](const cell::CellResult& cell) { take(sample, cell, given_up); };
    // an integrator takes too long for whole branches
    const std::vector<double> branches =
        integrates ? times_of_parts(job, 512, points, 0.5,
                                    [&](const auto& part, std::int64_t row) {
                                        for (const auto& point : regime::follow_branch(part, row, look))
                                            keep(point.cell);
                                    })
                   : times_of_stretches(scene::Scene(job), 512, points, 0.5, keep);
    const double all_cycles = std::max(sum(sample.cycles), 1.0);
    SampledCost cost{.cells = std::ssize(sample.cycles),
                     .cycles = all_cycles / static_cast<double>(sample.cycles.size()),
                     .seconds = mean(branches),
                     .relative_error = relative_error(branches),
                     .unseen_share = sample.unseen / all_cycles};
    double over_counted = 1;  // time of a cycle by the integrator asked for, over one of those counted
    if (!integrates && asks_for_integrator(asked)) {
        Sample few;
        for (std::int64_t n = 0; n < 12; ++n) {
            few.cells.push_back({n % job.row_count(), n * (job.columns.points - 1) / 11});
            few.cycles.push_back(1);
        }
        const std::vector<double> times = times_of_integrated_cycle(scene::Scene(job), few, asked.solver);
        cost.seconds = cost.cycles * mean(times);
        cost.relative_error = std::hypot(cost.relative_error, relative_error(times));
        over_counted = mean(times) / usual_cycle_time(job);
    }
    if (job.starts.count > 0 || job.uncertainty.rigs > 0) {
        const std::int64_t of_gap = job::branches_of_a_gap(job.sweep);
        const std::vector<double> many = times_of_parts(
            job, 32, std::min<std::int64_t>(points, 4), 2.0, [&](const auto& part, std::int64_t row) {
                if (job.starts.count > 0) {
                    static_cast<void>(attractors::find_along_branch(part, row - row % of_gap, look));
                } else {
                    static_cast<void>(attractors::find_outcomes_along_branch(part, row - row % of_gap, look));
                }
            });
        const double each =
            tries_left_out(asked, job) * over_counted * mean(many) / static_cast<double>(of_gap);
        const double error = std::hypot(cost.seconds * cost.relative_error, each * relative_error(many));
        cost.seconds += each;
        cost.relative_error = error / cost.seconds;
    }
    cost.spent = processor_time() - begin;
    return cost;
}

}  // namespace

// In the batch, on a rigid or a yielding stop; in the batch with the cubic spring kept, whose many kicks depend
// on the reach; one by one; by integrators, 130 to 320 on the stops tried.
double usual_cycle_time(const job::Job& job) {
    constexpr double us = 1e-6;
    const scene::Oscillator<double> rig = scene::Scene(job).cell(0, 0).oscillator;
    const job::EngineChoice engine = job.solver.engine;
    if (asks_for_integrator(job) || regime::has_nonlinear_contact(rig)) return 200 * us;
    if (!regime::may_use_batch(rig, job.solver)) return 1.3 * us;
    const bool keeps_cubic =
        rig.cubic != 0 && (engine == job::EngineChoice::split || job.solver.omit_tolerance == 0);
    return (keeps_cubic ? 2.6 : 0.33) * us;
}

SampledCost sample_cost(const job::Job& job) {
    const double begin = processor_time();
    const bool integrates = only_integrators(scene::Scene(job));
    const job::Job counted = counted_job(job, integrates);
    const scene::Scene scene(counted);
    if (job.kind == job::Kind::sweep) return cost_of_branches(job, counted, integrates);

    // a basin's attractors, whose search would take an integrator half a minute
    const regime::AttractorTable known = integrates ? regime::AttractorTable() : find_known_attractors(scene);
    const std::int64_t max_cycles = job.steady_state.max_cycles;
    constexpr double longest = 1.0;  // of the first few cells [s]
    const std::int64_t few = std::min<std::int64_t>(integrates ? 24 : 48, job.cells());
    Sample sample = solve_sample_for(longest, scene, known, few, integrates ? 1 : 4, max_cycles);
    if (!integrates && sample.seconds < longest) {
        // As many as take so long, judged by a few. When they run out, vectors are filled less: with 4,096
        // cells that takes a third of the time, or more.
        constexpr std::int64_t most = 16'384;
        constexpr double budget = 0.4;  // [s]
        const double each =
            std::max({sum(sample.cycles) * usual_cycle_time(counted), sample.seconds / 8, 1e-6}) /
            static_cast<double>(few);
        const std::int64_t size = std::min({most, job.cells(), static_cast<std::int64_t>(budget / each)});
        if (size > few) {
            std::vector<std::int64_t> all(static_cast<std::size_t>(size));
            std::iota(all.begin(), all.end(), 0);
            sample = {};
            solve_sample(sample, scene, known, all, size, max_cycles);
        }
    }
    const double tries = tries_left_out(job, counted);
    const auto size = std::ssize(sample.cells);

    const bool has_all = size == job.cells() && tries == 1;
    SampledCost cost{.cells = size,
                     .cycles = tries * mean(sample.cycles),
                     .seconds = tries * sample.seconds / static_cast<double>(size),
                     .relative_error = has_all ? 0 : relative_error(sample.cycles),
                     .unseen_share = sample.unseen / std::max(sum(sample.cycles), 1.0)};
    const bool integrated = !integrates && asks_for_integrator(job);
    if (job.audit.cells > 0 || integrated) {
        const std::vector<double> times = times_of_integrated_cycle(scene, sample, job.solver);
        cost.integrated_cycle = mean(times);
        if (integrated) {
            cost.seconds = cost.cycles * cost.integrated_cycle;
            cost.relative_error = std::hypot(cost.relative_error, times.empty() ? 0 : relative_error(times));
        }
    }
    cost.spent = processor_time() - begin;
    return cost;
}

SampledLives sample_lives(const job::Job& job) {
    constexpr double longest = 3;  // [s]
    constexpr std::int64_t most = 64;
    const bool integrates = only_integrators(scene::Scene(job)) || asks_for_integrator(job);
    const double most_cycles = integrates ? 1000 : 200'000;  // of a motion
    const job::Job counted = counted_job(job, only_integrators(scene::Scene(job)));
    job::Job noisy = counted;
    noisy.noise = job.noise;
    noisy.solver = job.solver;
    const double share = std::min(1.0, most_cycles / static_cast<double>(job.noise.cycles));
    const std::int64_t size = std::min(most, job.cells());
    const double begin = processor_time();
    std::vector<double> seconds;
    for (std::int64_t n = 0; n < size && processor_time() - begin < longest; ++n) {
        const std::int64_t cell = audited_cell(spread_place(n, size), size, job.cells());
        seconds.push_back(seconds_of_lives(counted, noisy, cell, share));
    }
    return {.cells = std::ssize(seconds),
            .spent = processor_time() - begin,
            .seconds = mean(seconds),
            .relative_error = std::ssize(seconds) == job.cells() && share == 1 ? 0 : relative_error(seconds)};
}

}  // namespace peterka
