#include "study/work_precision.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "regime/solve_cell.hpp"
#include "support/stopwatch.hpp"

namespace peterka::study {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double same_orbit = 0.05;  // error of the state beyond which a run is on another orbit
constexpr std::array<const char*, 3> outcome_names{"done", "failed", "other_orbit"};

using Result = WorkPrecision::Result;
using TrialEnd = WorkPrecision::TrialEnd;

double relative(const State<double>& x, const State<Extended>& expected) {
    const State<Extended> difference = (x.cast<Extended>() - expected).cwiseAbs();
    const State<Extended> size = expected.cwiseAbs().array() + 1;
    return static_cast<double>(difference.cwiseQuotient(size).maxCoeff());
}

double distance(double a, Extended b) {
    return static_cast<double>(std::abs(static_cast<Extended>(a) - b));
}

// Errors of one period that begins at the orbit's point number `shift`.
Result compared(const std::vector<Observation>& cycles, const ReferenceOrbit& orbit, std::size_t shift,
                Extended forcing_period) {
    Result result{TrialEnd::done, 0, 0, 0, nan};
    double peak_force = 0;
    std::int64_t impacts = 0;
    for (std::size_t n = 0; n < cycles.size(); ++n) {
        const ReferenceCycle& expected = orbit.cycles[(n + shift) % orbit.period()];
        result.error_state = std::max(result.error_state, relative(cycles[n].end, expected.end));
        peak_force = std::max(peak_force, cycles[n].peak_force);
        impacts += cycles[n].impacts;
        if (expected.impacts > 0) {
            const double late = distance(cycles[n].last_touch, expected.last_touch);
            // NaN, where the impact is missing, must not be lost in a maximum
            if (!(late <= result.error_impact_time)) result.error_impact_time = late;
        }
    }
    result.error_impact_time /= static_cast<double>(forcing_period);
    result.error_peak_force =
        distance(peak_force, orbit.peak_force()) / static_cast<double>(orbit.peak_force());
    const bool same = impacts == orbit.impacts() && result.error_state < same_orbit;
    if (!same) result.outcome = TrialEnd::other_orbit;
    return result;
}

}  // namespace

WorkPrecision::WorkPrecision(const job::Job& job)
    : study_(job.study),
      budget_(job.steady_state),
      force_ratio_(scene::scales_of(job).force_ratio()),
      runs_(runs(scene::oscillator_of(job).cubic != 0, study_.tolerances, study_.steps_per_cycle)) {
    for (const job::CellNumbers& numbers : job::numbers_of_cells(job)) {
        Trial cell{scene::oscillator_of(job), {0, 0}};
        cell.oscillator.frequency = numbers.frequency_ratio();
        cell.oscillator.gap = numbers.gap_ratio();
        cell.start = {-cell.oscillator.gap, -cell.oscillator.frequency};  // at rest
        cells_.push_back(cell);
    }
    orbits_.resize(cells_.size());
}

const WorkPrecision::Orbit& WorkPrecision::orbit(std::size_t cell) const {
    std::optional<Orbit>& known = orbits_[cell];
    if (!known) known = reference_orbit(cells_[cell].oscillator, cells_[cell].start, budget_);
    return *known;
}

std::int64_t WorkPrecision::tasks() const {
    return std::ssize(runs_) * std::ssize(cells_);
}

const BatchTrial& WorkPrecision::batch_trial() const {
    if (!batch_trial_) {
        std::vector<OrbitStart> starts;
        for (std::size_t n = 0; n < cells_.size(); ++n) {
            if (!orbit(n)) continue;
            starts.push_back({cells_[n].oscillator, orbit(n)->points[0].cast<double>(), orbit(n)->period()});
        }
        BatchTrial trial = follow_in_batch(starts, study_.cycles, study_.repeats);
        for (std::size_t n = 0; n < cells_.size(); ++n) {
            if (!orbit(n)) trial.orbits.insert(trial.orbits.begin() + static_cast<std::ptrdiff_t>(n), 1, {});
        }
        batch_trial_ = std::move(trial);
    }
    return *batch_trial_;
}

std::optional<WorkPrecision::TimedOrbit> WorkPrecision::follow(const Run& run, std::size_t cell) const {
    const ReferenceOrbit& expected = *orbit(cell);
    if (run.method == Method::batched) {
        const BatchTrial& trial = batch_trial();
        if (!std::ranges::all_of(trial.orbits[cell], &Observation::ok)) return std::nullopt;
        return TimedOrbit{trial.seconds_per_cycle, trial.orbits[cell]};
    }
    MethodMap map(cells_[cell].oscillator, run, static_cast<double>(expected.largest_displacement()));
    const State<double> start = expected.points[0].cast<double>();
    State<double> x = start;
    double fastest = std::numeric_limits<double>::infinity();
    for (std::int64_t repeat = 0; repeat < study_.repeats; ++repeat) {
        x = start;
        const Stopwatch stopwatch;
        for (std::int64_t n = 0; n < study_.cycles; ++n) {
            if (!map.advance(x)) return std::nullopt;
        }
        fastest = std::min(fastest, stopwatch.seconds());
    }
    TimedOrbit followed{fastest / static_cast<double>(study_.cycles), {}};
    for (std::size_t n = 0; n < expected.period(); ++n) {
        followed.cycles.push_back(map.observe(x));
        if (!followed.cycles.back().ok) return std::nullopt;
        x = followed.cycles.back().end;
    }
    return followed;
}

Result WorkPrecision::solve(std::int64_t task) const {
    const auto number = static_cast<std::size_t>(task % std::ssize(cells_));
    const Result failed{TrialEnd::failed, nan, nan, nan, nan};
    if (!orbit(number)) return failed;
    const ReferenceOrbit& expected = *orbit(number);
    const auto followed = follow(runs_[static_cast<std::size_t>(task / std::ssize(cells_))], number);
    if (!followed) return failed;

    // a coarse method may have slipped by a cycle on an orbit of several
    Result best = failed;
    best.error_state = std::numeric_limits<double>::infinity();
    for (std::size_t shift = 0; shift < expected.period(); ++shift) {
        const Result result =
            compared(followed->cycles, expected, shift,
                     2 * std::numbers::pi_v<Extended> / Extended(cells_[number].oscillator.frequency));
        if (result.error_state < best.error_state) best = result;
    }
    best.seconds_per_cycle = followed->seconds_per_cycle;
    return best;
}

std::vector<Table> WorkPrecision::tables(std::span<const Result> results) const {
    using hdf5::Number;
    using hdf5::Variable;
    const map_file::Dimension cell{"cell", std::ssize(cells_)};
    const map_file::Dimension trial{"trial", std::ssize(runs_)};
    const auto of_cells = [&](auto value) {
        std::vector<double> values;
        for (std::size_t n = 0; n < cells_.size(); ++n) values.push_back(static_cast<double>(value(n)));
        return values;
    };
    const auto of_runs = [&](auto value) {
        std::vector<double> values;
        for (std::size_t n = 0; n < runs_.size(); ++n) values.push_back(static_cast<double>(value(n)));
        return values;
    };
    const auto of_results = [&](auto member) {
        std::vector<double> values;
        for (const Result& result : results) values.push_back(static_cast<double>(result.*member));
        return values;
    };
    const auto number = [](std::size_t n) { return n; };
    // clang-format off
    return {
        {{"/", Variable{"cell", Number::int32, -1, "1", "number of the cell"}, {cell}}, of_cells(number)},
        {{"/", Variable{"trial", Number::int32, -1, "1", "number of the trial: a method at a setting"}, {trial}}, of_runs(number)},
        {{"/", Variable{"frequency_ratio", Number::float64, nan, "1", "excitation frequency over natural frequency, Omega/omega"}, {cell}}, of_cells([&](std::size_t n) { return cells_[n].oscillator.frequency; })},
        {{"/", Variable{"gap_ratio", Number::float64, nan, "1", "gap over cart amplitude, gap/A0"}, {cell}}, of_cells([&](std::size_t n) { return cells_[n].oscillator.gap; })},
        {{"/", Variable{"reference_peak_force_ratio", Number::float64, nan, "1", "peak force of the cell's orbit in extended precision over the hammer's weight, F/(m g0)"}, {cell}},
         of_cells([&](std::size_t n) { return orbit(n) ? static_cast<double>(orbit(n)->peak_force()) * force_ratio_ : nan; })},
        {{"/", Variable{"method", Number::int8, -128, "1", "way to carry a trajectory through a cycle", method_names}, {trial}}, of_runs([&](std::size_t n) { return static_cast<int>(runs_[n].method); })},
        {{"/", Variable{"setting", Number::float64, nan, "1", "relative error in peak force asked for; steps per forcing cycle of methods with a fixed step; 0 where there is none"}, {trial}}, of_runs([&](std::size_t n) { return runs_[n].setting; })},
        {{"/", Variable{"outcome", Number::int8, -128, "1", "what became of the trial", outcome_names}, {trial, cell}}, of_results(&Result::outcome)},
        {{"/", Variable{"error_peak_force", Number::float64, nan, "1", "relative error of the peak force"}, {trial, cell}}, of_results(&Result::error_peak_force)},
        {{"/", Variable{"error_state", Number::float64, nan, "1", "error of the stroboscopic state, each part over 1 + its size"}, {trial, cell}}, of_results(&Result::error_state)},
        {{"/", Variable{"error_impact_time", Number::float64, nan, "1", "error of the time of an impact, in forcing cycles"}, {trial, cell}}, of_results(&Result::error_impact_time)},
        {{"/run", Variable{"cell", Number::int32, -1, "1", "number of the cell"}, {cell}}, of_cells(number)},
        {{"/run", Variable{"trial", Number::int32, -1, "1", "number of the trial: a method at a setting"}, {trial}}, of_runs(number)},
        {{"/run", Variable{"seconds_per_cycle", Number::float64, nan, "s", "computing time of a forcing cycle"}, {trial, cell}}, of_results(&Result::seconds_per_cycle)},
    };
    // clang-format on
}

std::string WorkPrecision::summary(std::span<const Result> results) const {
    std::string text = fmt::format(
        "\nMedian over {} cells, {} forcing cycles each\n  {:<20}{:>10}{:>16}{:>14}{:>10}\n", cells_.size(),
        study_.cycles, "method", "setting", "error of peak", "us per cycle", "not done");
    for (std::size_t n = 0; n < runs_.size(); ++n) {
        std::vector<double> errors;
        std::vector<double> times;
        for (const Result& result : results.subspan(n * cells_.size(), cells_.size())) {
            if (result.outcome != TrialEnd::done) continue;
            errors.push_back(result.error_peak_force);
            times.push_back(1e6 * result.seconds_per_cycle);
        }
        const std::size_t missing = cells_.size() - errors.size();
        const auto median = [](std::vector<double>& values) {
            if (values.empty()) return nan;
            std::ranges::sort(values);
            return values[values.size() / 2];
        };
        text += fmt::format("  {:<20}{:>10g}{:>16.1e}{:>14.3g}{:>10}\n",
                            method_names[static_cast<std::size_t>(runs_[n].method)], runs_[n].setting,
                            median(errors), median(times), missing == 0 ? "" : fmt::format("{}", missing));
    }
    return text;
}

}  // namespace peterka::study
