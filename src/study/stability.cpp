#include "study/stability.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "quantities/fields.hpp"
#include "regime/solve_cell.hpp"
#include "study/battery.hpp"
#include "study/rigid_limit.hpp"
#include "study/verdict.hpp"
#include "support/stopwatch.hpp"

namespace peterka::study {

namespace {

using regime::CellResult;
using regime::Engine;
using regime::EngineSettings;
using regime::Regime;
using Judgement = Stability::Judgement;
using OfEngine = Stability::OfEngine;
using Result = Stability::Result;
using scene::Oscillator;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double allowed = 10;  // error of the peak force, over the requested tolerance
constexpr std::array<const char*, 4> outcome_names{"agrees", "says_why_not", "wrong", "not_for_this_scene"};

// Whether an engine supports the oscillator.
bool fits(Engine engine, const Oscillator<double>& oscillator, const EngineSettings& settings) {
    const bool linear = scene::has_closed_form(oscillator.contact);
    switch (engine) {
        case Engine::exact:
            return linear && oscillator.cubic == 0;
        case Engine::split:
            return linear &&
                   trajectory::split_steps(oscillator, settings.largest_displacement, settings.tolerance) > 0;
        case Engine::cvode:
        case Engine::arkode:
            break;
    }
    return true;
}

job::EngineChoice choice_of(Engine engine) {
    switch (engine) {
        case Engine::exact:
            break;
        case Engine::split:
            return job::EngineChoice::split;
        case Engine::cvode:
            return job::EngineChoice::cvode;
        case Engine::arkode:
            return job::EngineChoice::arkode;
    }
    return job::EngineChoice::exact;
}

// On return, the settings are those of the last search.
CellResult solve(const scene::Cell& cell, const job::SteadyState& budget, EngineSettings& settings) {
    regime::EngineByReach engine(cell.oscillator,
                                 {.engine = choice_of(settings.engine), .tolerance = settings.tolerance},
                                 settings.largest_displacement);
    CellResult result;
    do {
        result = regime::find_steady_state(cell.oscillator, cell.start, budget, engine.settings());
    } while (engine.must_change(result.largest_displacement) &&
             fits(settings.engine, cell.oscillator, engine.settings()));
    settings = engine.settings();
    return result;
}

// The relative energy imbalance of one period, as the engine itself computes it.
double energy_imbalance(const scene::Cell& cell, const EngineSettings& settings, const CellResult& result) {
    const bool settled = result.regime == Regime::periodic || result.regime == Regime::no_impact ||
                         result.regime == Regime::sustained_contact;
    // the absolute cubic form pulls at the cart, whose motion does work that no integral here includes
    const bool pulls_at_cart =
        cell.oscillator.cubic != 0 && cell.oscillator.cubic_form == job::CubicForm::absolute;
    if (!settled || pulls_at_cart) return nan;
    regime::CycleMap map = regime::make_cycle_map(cell.oscillator, settings);
    trajectory::Recorder<double> recorder(trajectory::Detail::energy);
    scene::State<double> x(result.orbit_displacement - cell.oscillator.gap, result.orbit_velocity);
    for (int round = 0; round < 2; ++round) {  // the first completes the events open at phase 0
        recorder.reset_totals();
        for (std::int32_t n = 0; n < result.period; ++n) {
            const auto cycle = std::visit([&](auto& m) { return m(x, &recorder); }, map);
            if (cycle.outcome != trajectory::Cycle<double>::Outcome::done) return nan;
            x = cycle.end;
        }
    }
    const auto& totals = recorder.totals();
    const double lost = totals.damper_work + totals.contact_work;
    const double scale = std::max(std::abs(totals.drive_work), lost);
    if (!(lost > 0)) return nan;
    return (totals.drive_work - totals.damper_work - totals.contact_work) / scale;
}

double error_of(double peak_force, const Verdict& verdict) {
    if (verdict.kind != Verdict::Kind::settled) return nan;
    const auto difference = static_cast<double>(std::abs(Extended(peak_force) - verdict.peak_force));
    return verdict.peak_force > 0 ? difference / static_cast<double>(verdict.peak_force) : difference;
}

bool same_label(const CellResult& result, const Verdict& verdict) {
    if (verdict.kind == Verdict::Kind::chaotic) return result.regime == Regime::chaotic;
    return verdict.kind == Verdict::Kind::settled && result.regime == verdict.regime &&
           result.impacts == verdict.impacts && result.period == verdict.period;
}

bool is_close(double peak_force, const Verdict& verdict, double margin) {
    if (verdict.kind != Verdict::Kind::settled || std::isnan(verdict.peak_force)) return true;
    return error_of(peak_force, verdict) <= margin;
}

// Scenes whose gap or frequency is perturbed by the tolerance.
std::vector<scene::Cell> neighbours(const scene::Cell& cell, double tolerance) {
    std::vector<scene::Cell> cells;
    for (const double side : {-1.0, 1.0}) {
        scene::Cell other_gap = cell;
        const double shift = side * tolerance * (1 + std::abs(cell.oscillator.gap));
        other_gap.oscillator.gap += shift;
        other_gap.start[0] -= shift;
        cells.push_back(other_gap);
        scene::Cell other_frequency = cell;
        other_frequency.oscillator.frequency *= 1 + side * tolerance;
        cells.push_back(other_frequency);
    }
    return cells;
}

Judgement outcome_of(const CellResult& result, const scene::Cell& cell, const Verdict& verdict,
                     double tolerance) {
    if (result.regime == Regime::unresolved || result.regime == Regime::failed) return Judgement::says_why_not;
    bool is_label = same_label(result, verdict);
    double margin = allowed * tolerance;
    if (is_label && is_close(result.peak_force, verdict, margin)) return Judgement::agrees;
    for (const scene::Cell& neighbour : neighbours(cell, tolerance)) {
        const Verdict other = judge(neighbour.oscillator, neighbour.start);
        is_label |= same_label(result, other);
        if (other.kind != Verdict::Kind::settled || verdict.kind != Verdict::Kind::settled) continue;
        margin = std::max(margin, allowed * error_of(static_cast<double>(other.peak_force), verdict));
    }
    return is_label && is_close(result.peak_force, verdict, margin) ? Judgement::agrees : Judgement::wrong;
}

// Least squares in logarithms, over the stiffest half of the ladder.
double fitted_slope(std::span<const Result> rungs) {
    double n = 0;
    double sx = 0;
    double sy = 0;
    double sxx = 0;
    double sxy = 0;
    for (std::size_t rung = rungs.size() / 2; rung < rungs.size(); ++rung) {
        const double x = std::log(rung_stiffness(static_cast<std::int64_t>(rung)));
        const double y = std::log(std::abs(rungs[rung].speed_difference));
        n += 1;
        sx += x;
        sy += y;
        sxx += x * x;
        sxy += x * y;
    }
    return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

}  // namespace

std::int64_t Stability::tasks() const {
    return std::ssize(battery()) + rigid_limit_rungs;
}

Result Stability::solve(std::int64_t task) const {
    const std::int64_t rung = task - std::ssize(battery());
    if (rung < 0) return solve_scene(task);
    Result result;
    const RigidLimit limit;
    result.speed_difference = limit.compliant_speed(rung_stiffness(rung)) - limit.rigid_speed();
    return result;
}

Result Stability::solve_scene(std::int64_t number) const {
    const scene::Cell cell = cell_of(battery()[static_cast<std::size_t>(number)], job_);
    const job::SteadyState& budget = job_.steady_state;
    const Verdict verdict = judge(cell.oscillator, cell.start);
    Result result;
    for (std::size_t n = 0; n < engines; ++n) {
        EngineSettings settings{.engine = static_cast<Engine>(n), .tolerance = job_.solver.tolerance};
        if (!fits(settings.engine, cell.oscillator, settings)) continue;
        const Stopwatch stopwatch;
        const CellResult solved = study::solve(cell, budget, settings);
        OfEngine& of_engine = result.of_engines[n];
        of_engine.seconds = stopwatch.seconds();
        of_engine.regime = solved.regime;
        of_engine.status = solved.status;
        of_engine.impacts = solved.impacts;
        of_engine.period = solved.period;
        of_engine.error_peak_force = error_of(solved.peak_force, verdict);
        of_engine.energy_imbalance = energy_imbalance(cell, settings, solved);
        of_engine.outcome = outcome_of(solved, cell, verdict, settings.tolerance);
    }
    return result;
}

std::vector<Table> Stability::tables(std::span<const Result> results) const {
    using hdf5::Number;
    using hdf5::Variable;
    const auto scenes = battery().size();
    const map_file::Dimension scene{"scene", std::ssize(battery())};
    const map_file::Dimension engine{"engine", static_cast<std::int64_t>(engines)};
    const map_file::Dimension rung{"rung", rigid_limit_rungs};
    const auto numbers = [](std::size_t size) {
        std::vector<double> values;
        for (std::size_t n = 0; n < size; ++n) values.push_back(static_cast<double>(n));
        return values;
    };
    const auto of_engines = [&](auto member) {
        std::vector<double> values;
        for (const Result& result : results.first(scenes)) {
            for (const OfEngine& each : result.of_engines) values.push_back(static_cast<double>(each.*member));
        }
        return values;
    };
    std::vector<double> stiffness;
    std::vector<double> difference;
    for (const Result& result : results.subspan(scenes)) {
        stiffness.push_back(rung_stiffness(std::ssize(stiffness)));
        difference.push_back(result.speed_difference);
    }
    const double slope = fitted_slope(results.subspan(scenes));
    // clang-format off
    return {
        {{"/", Variable{"scene", Number::int32, -1, "1", "scene of the battery", battery_names()}, {scene}}, numbers(scenes)},
        {{"/", Variable{"engine", Number::int8, -128, "1", "engine", cell::engine_names}, {engine}}, numbers(engines)},
        {{"/", Variable{"rung", Number::int32, -1, "1", "rung of the ladder of stiffnesses"}, {rung}}, numbers(results.size() - scenes)},
        {{"/", Variable{"outcome", Number::int8, -128, "1", "what the reference says of the engine's result", outcome_names}, {scene, engine}}, of_engines(&OfEngine::outcome)},
        {{"/", Variable{"regime", Number::int8, -128, "1", "regime", cell::regime_names}, {scene, engine}}, of_engines(&OfEngine::regime)},
        {{"/", Variable{"status", Number::int8, -128, "1", "why there is no regime", cell::status_names}, {scene, engine}}, of_engines(&OfEngine::status)},
        {{"/", Variable{"impacts", Number::int32, -1, "1", "p of z = p/q, impacts per period"}, {scene, engine}}, of_engines(&OfEngine::impacts)},
        {{"/", Variable{"period", Number::int32, -1, "1", "q of z = p/q, forcing cycles per period"}, {scene, engine}}, of_engines(&OfEngine::period)},
        {{"/", Variable{"error_peak_force", Number::float64, nan, "1", "relative error of the peak force"}, {scene, engine}}, of_engines(&OfEngine::error_peak_force)},
        {{"/", Variable{"energy_imbalance", Number::float64, nan, "1", "drive work less losses over a period, over the drive work"}, {scene, engine}}, of_engines(&OfEngine::energy_imbalance)},
        {{"/", Variable{"contact_stiffness", Number::float64, nan, "1", "stiffness of the stop over that of the springs, ki/k"}, {rung}}, stiffness},
        {{"/", Variable{"speed_difference", Number::float64, nan, "1", "impact speed less that of the rigid stop, over A0 omega"}, {rung}}, difference},
        {{"/", Variable{"fitted_slope", Number::float64, nan, "1", "of ln |speed_difference| by ln contact_stiffness; -1/2 in theory"}, {}}, {slope}},
        {{"/run", Variable{"scene", Number::int32, -1, "1", "scene of the battery", battery_names()}, {scene}}, numbers(scenes)},
        {{"/run", Variable{"engine", Number::int8, -128, "1", "engine", cell::engine_names}, {engine}}, numbers(engines)},
        {{"/run", Variable{"seconds", Number::float64, nan, "s", "computing time"}, {scene, engine}}, of_engines(&OfEngine::seconds)},
    };
    // clang-format on
}

std::string Stability::summary(std::span<const Result> results) const {
    std::string text = fmt::format("\n{:<30}", "scene");
    for (const char* engine : cell::engine_names) text += fmt::format("{:<24}", engine);
    text += "\n";
    int wrong = 0;
    for (std::size_t n = 0; n < battery().size(); ++n) {
        text += fmt::format("{:<30}", battery()[n].name);
        for (const OfEngine& each : results[n].of_engines) {
            std::string word = outcome_names[static_cast<std::size_t>(each.outcome)];
            if (each.outcome == Judgement::says_why_not) {
                word = cell::status_names[static_cast<std::size_t>(each.status)];
            } else if (each.outcome == Judgement::not_for_this_scene) {
                word = "-";
            } else if (!std::isnan(each.error_peak_force)) {
                word += fmt::format(" {:.0e}", each.error_peak_force);
            }
            wrong += each.outcome == Judgement::wrong ? 1 : 0;
            text += fmt::format("{:<24}", word);
        }
        text += "\n";
    }
    text += fmt::format("{} wrong; impact speeds tend to those of a rigid stop like stiffness^{:.4f}\n", wrong,
                        fitted_slope(results.subspan(battery().size())));
    return text;
}

}  // namespace peterka::study
