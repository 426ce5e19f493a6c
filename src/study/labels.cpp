#include "study/labels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "regime/solve_cell.hpp"
#include "support/expect.hpp"
#include "support/stopwatch.hpp"

namespace peterka::study {

namespace {

using regime::Engine;

Method method_of(Engine engine, const Oscillator<double>& oscillator) {
    if (engine == Engine::exact) return Method::exact;
    if (engine == Engine::split) return Method::split;
    switch (regime::integrator_of(oscillator, engine)) {
        case integrators::Integrator::cvode_adams:
            return Method::cvode_adams;
        case integrators::Integrator::cvode_bdf:
            return Method::cvode_bdf;
        case integrators::Integrator::arkode_explicit:
            return Method::arkode_explicit;
        case integrators::Integrator::arkode_implicit:
            break;
    }
    return Method::arkode_implicit;
}

}  // namespace

Labels::Labels(const job::Job& job) : scene_(job) {
    const Oscillator<double> rig = scene_.cell(0, 0).oscillator;
    const bool cubic = rig.cubic != 0;
    const auto add = [&](Engine engine, double tolerance) {
        runs_.push_back({engine, {method_of(engine, rig), tolerance}});
    };
    if (!cubic) add(Engine::exact, 0);
    for (const Engine engine : {Engine::split, Engine::cvode, Engine::arkode}) {
        if (engine == Engine::split && !cubic) continue;
        for (const double tolerance : job.study.tolerances) add(engine, tolerance);
    }
    if (!cubic) return;
    for (std::size_t n = 0; n < runs_.size(); ++n) {
        const bool tighter =
            runs_[reference_].engine != Engine::arkode || runs_[n].run.setting < runs_[reference_].run.setting;
        if (runs_[n].engine == Engine::arkode && tighter) reference_ = n;
    }
}

Labels::Result Labels::solve(std::int64_t task) const {
    PETERKA_EXPECT(0 <= task && task / cells() < std::ssize(runs_));
    const EngineRun& run = runs_[static_cast<std::size_t>(task / cells())];
    const std::int64_t index = task % cells();
    const scene::Cell cell = scene_.cell(index / scene_.columns(), index % scene_.columns());
    regime::EngineSettings settings{.engine = run.engine};
    if (run.engine != Engine::exact) settings.tolerance = run.run.setting;
    const Stopwatch stopwatch;
    const regime::CellResult solved =
        regime::find_steady_state(cell.oscillator, cell.start, scene_.job().steady_state, settings);
    return {solved.regime, solved.impacts, solved.period, stopwatch.seconds()};
}

Labels::Shares Labels::shares(std::span<const Result> results) const {
    const auto count = static_cast<std::size_t>(cells());
    const auto expected = results.subspan(reference_ * count, count);
    Shares shares;
    for (std::size_t n = 0; n < runs_.size(); ++n) {
        const auto cells_of_run = results.subspan(n * count, count);
        double changed = 0;
        double unproved = 0;
        double seconds = 0;
        for (std::size_t cell = 0; cell < count; ++cell) {
            changed += cells_of_run[cell].same_label(expected[cell]) ? 0 : 1;
            unproved += cells_of_run[cell].is_proved() ? 0 : 1;
            seconds += cells_of_run[cell].seconds;
        }
        shares.changed.push_back(changed / static_cast<double>(count));
        shares.unproved.push_back(unproved / static_cast<double>(count));
        shares.seconds.push_back(seconds / static_cast<double>(count));
    }
    return shares;
}

std::vector<Table> Labels::tables(std::span<const Result> results) const {
    using hdf5::Number;
    using hdf5::Variable;
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    const map_file::Dimension trial{"trial", std::ssize(runs_)};
    const Shares of_runs = shares(results);
    std::vector<double> numbers;
    std::vector<double> methods;
    std::vector<double> settings;
    for (const EngineRun& each : runs_) {
        numbers.push_back(static_cast<double>(numbers.size()));
        methods.push_back(static_cast<double>(each.run.method));
        settings.push_back(each.run.setting);
    }
    // clang-format off
    return {
        {{"/", Variable{"trial", Number::int32, -1, "1", "number of the trial: an engine at a tolerance"}, {trial}}, numbers},
        {{"/", Variable{"method", Number::int8, -128, "1", "way to carry a trajectory through a cycle", method_names}, {trial}}, methods},
        {{"/", Variable{"setting", Number::float64, nan, "1", "relative error in peak force asked for; 0 where there is none"}, {trial}}, settings},
        {{"/", Variable{"changed_share", Number::float64, nan, "1", "share of the cells whose regime or z = p/q is not that of the reference trial"}, {trial}}, of_runs.changed},
        {{"/", Variable{"unproved_share", Number::float64, nan, "1", "share of the cells that are unresolved or failed"}, {trial}}, of_runs.unproved},
        {{"/", Variable{"reference_trial", Number::int32, -1, "1", "number of the trial that gives the labels to compare with"}, {}}, {static_cast<double>(reference_)}},
        {{"/", Variable{"cells", Number::int64, 0, "1", "cells of the map"}, {}}, {static_cast<double>(cells())}},
        {{"/run", Variable{"trial", Number::int32, -1, "1", "number of the trial: an engine at a tolerance"}, {trial}}, numbers},
        {{"/run", Variable{"seconds_per_cell", Number::float64, nan, "s", "mean computing time of a cell"}, {trial}}, of_runs.seconds},
    };
    // clang-format on
}

std::string Labels::summary(std::span<const Result> results) const {
    const Shares of_runs = shares(results);
    std::string text = fmt::format("\n{} cells with each engine\n  {:<20}{:>10}{:>12}{:>12}{:>14}\n", cells(),
                                   "method", "tolerance", "changed", "not settled", "ms per cell");
    for (std::size_t n = 0; n < runs_.size(); ++n) {
        text += fmt::format("  {:<20}{:>10g}{:>10.3g} %{:>10.3g} %{:>14.3g}\n",
                            method_names[static_cast<std::size_t>(runs_[n].run.method)], runs_[n].run.setting,
                            100 * of_runs.changed[n], 100 * of_runs.unproved[n], 1e3 * of_runs.seconds[n]);
    }
    return text;
}

}  // namespace peterka::study
