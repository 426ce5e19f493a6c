#include "report/summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "job/axis.hpp"
#include "job/axis_quantity.hpp"
#include "job/names.hpp"
#include "regime/solve_cell.hpp"
#include "report/axis_words.hpp"
#include "report/closing_lines.hpp"
#include "report/outcomes_summary.hpp"
#include "report/regime_words.hpp"
#include "report/starts_inside.hpp"
#include "report/summary_parts.hpp"
#include "support/readable.hpp"

namespace peterka {
namespace {

using findings::LargestForce;
using findings::Statistics;
using regime::Regime;

std::string what_the_cells_are(const job::Job& job) {
    switch (job.kind) {
        case job::Kind::basin:
            return "starts at " + place_in_words(job);
        case job::Kind::sweep:
        case job::Kind::map:
        case job::Kind::study:
        case job::Kind::trace:
        case job::Kind::curves:
            break;
    }
    return plane_in_words(job);
}

std::string heading(const SummaryInput& input) {
    const job::Job& job = input.scene.job();
    return fmt::format("\n{}\n{} cells: {} by {} {}\n", job.title.empty() ? "(no title)" : job.title,
                       readable_count(input.findings.statistics.counts.cells),
                       readable_count(job.columns.points), readable_count(job.row_count()),
                       what_the_cells_are(job));
}

std::string starts(const SummaryInput& input) {
    const std::string inside = starts_inside(input.scene);
    return inside.empty() ? "" : fmt::format("{}\n", inside);
}

// A maximum on the border of the plane may continue to grow beyond it.
std::string border(const job::Job& job, const LargestForce& force) {
    std::string borders;
    const auto add = [&](std::string_view key, std::int64_t place, std::int64_t points) {
        if (points == 1 || (place > 0 && place + 1 < points)) return;
        borders += fmt::format("{}{}", borders.empty() ? "" : ", ", end_in_words(key, place > 0));
    };
    add(column_key(job), force.column, job.columns.points);
    if (job.kind == job::Kind::map) add(row_key(job), force.row, job.rows.points);
    if (borders.empty()) return "";
    return fmt::format(", on the {}'s border ({})", job::name(job.kind), borders);
}

// Some cells keep the cubic spring, which others omit.
std::string but_for_cubic(const SummaryInput& input) {
    const auto& cells = input.findings.statistics.counts.by_engine;
    const auto of = [&](regime::Engine engine) { return cells[static_cast<std::size_t>(engine)]; };
    if (of(regime::Engine::exact) == 0 || of(regime::Engine::split) == 0) return "";
    return fmt::format(", to {:g} of it where the cubic spring is left out",
                       input.scene.job().solver.omit_tolerance);
}

// A motion with a period has one force, whatever start leads to it.
std::string place_in_basin(const SummaryInput& input, const LargestForce& force) {
    const auto regime = static_cast<Regime>(force.regime);
    if (regime::has_period(regime)) {
        const char* motion = regime == Regime::periodic ? "on an orbit" : "in lasting contact";
        return fmt::format("{}: the same from every start that leads to it{}", motion, but_for_cubic(input));
    }
    return "without a period, from " + start_in_words(input.scene, force.row, force.column);
}

std::string place(const SummaryInput& input, const LargestForce& force) {
    const job::Job& job = input.scene.job();
    if (job.kind == job::Kind::basin) return place_in_basin(input, force);
    return fmt::format("at {}{}", place_in_words(input.scene, force.row, force.column), border(job, force));
}

std::string force_line(const SummaryInput& input, const char* of, const LargestForce& force) {
    if (!force.found() || !(force.peak_force_ratio > 0)) return "";
    const double weight = input.scene.cell(force.row, force.column).scales.weight_n;
    return fmt::format("  {:<12}{:<26} {}\n", of,
                       force_in_words(input.scene.job(), force.peak_force_ratio, weight), place(input, force));
}

bool strikes(const Statistics& statistics) {
    return statistics.cells_of(Regime::periodic) + statistics.cells_of(Regime::chaotic) +
               statistics.cells_of(Regime::unresolved) >
           0;
}

std::string forces(const SummaryInput& input) {
    const auto& largest = input.findings.statistics.largest;
    if (job::is_rigid(input.scene.job().contact) && strikes(input.findings.statistics)) {
        const job::Output& output = input.scene.job().output;
        const bool asks =
            output.has(job::OptionalField::impact_speed) || output.has(job::OptionalField::impulse);
        return fmt::format("\nNo peak forces: a rigid stop strikes with forces beyond any bound. {}\n",
                           asks ? "The file has what was asked for instead,\nimpact_speed or impulse."
                                : "Ask for impact_speed or impulse\nunder [output] fields instead.");
    }
    const std::string lines =
        force_line(input, "of all", largest.any_regime) + force_line(input, "of z = 1/1", largest.one_to_one);
    if (lines.empty()) return "\nNo cell strikes the stop for ever.\n";
    const auto is_mass = [](std::string_view key) { return key == "hammer.mass_kg"; };
    const std::string weight =
        has_axis(input.scene.job(), is_mass)
            ? std::string("the largest in N; in weights, those that the hammer has there")
            : fmt::format("the hammer weighs {}", readable_amount(input.scene.scales().weight_n, "N", 3));
    return fmt::format("\nLargest peak force ({})\n{}", weight, lines);
}

std::string refinement(const Statistics& statistics) {
    if (statistics.counts.filled == 0) return "";
    const std::int64_t cells = statistics.counts.cells;
    const std::int64_t computed = cells - statistics.counts.filled;
    return fmt::format("  {} of {} cells computed ({}), the others filled from those around them\n",
                       readable_count(computed), readable_count(cells), readable_share(computed, cells));
}

std::string effort(const SummaryInput& input) {
    const Statistics& statistics = input.findings.statistics;
    const auto cells = static_cast<double>(std::max<std::int64_t>(statistics.counts.cells, 1));
    return fmt::format(
        "\nWork\n{}  {} forcing cycles and {} per cell, {} on the clocks of all ranks together\n"
        "  this run: {} on {} {}\n",
        refinement(statistics), readable_mean(static_cast<double>(statistics.counts.cycles) / cells),
        readable_duration(statistics.tile_seconds / cells), readable_duration(statistics.tile_seconds),
        readable_duration(input.effort.wall_seconds), input.effort.ranks,
        input.effort.ranks == 1 ? "rank" : "ranks");
}

std::string audit(const SummaryInput& input) {
    if (!input.findings.audit) return "";
    const findings::Counts& counts = input.findings.statistics.counts;
    const auto cells = static_cast<double>(std::max<std::int64_t>(counts.cells - counts.filled, 1));
    return audit_summary(*input.findings.audit, input.findings.statistics.tile_seconds / cells);
}

std::string omitted(const SummaryInput& input) {
    if (input.findings.omitted.empty()) return "";
    std::string text = "\nLeft out, because it changes nothing asked for\n";
    for (const std::string& sentence : input.findings.omitted) text += fmt::format("  - {}\n", sentence);
    return text;
}

}  // namespace

std::string summary_text(const SummaryInput& input) {
    const char* kind = input.scene.job().kind == job::Kind::sweep ? "Sweep file" : "Map file";
    return heading(input) + starts(input) + regimes_in_words(input.findings.statistics) +
           basin_summary(input.scene, input.findings.basin) +
           long_chaos(input.scene, input.findings.statistics) +
           starts_summary(input.scene, input.findings.statistics.starts) +
           outcomes_summary(input.scene.job(), input.findings.statistics.outcomes) +
           kicks_summary(input.scene, input.findings.statistics.starts.counts.kicks) +
           lives_summary(input.scene, input.findings.statistics.starts.counts.lives) +
           transients_in_words(input.scene.job(), input.findings.statistics.transients) + forces(input) +
           elasticities_summary(input.scene.job(), input.findings.statistics) +
           sweep_summary(input.scene, input.findings.sweep.branches, input.findings.sweep.beside) +
           input.borders + effort(input) + certificate_summary(input.scene, input.findings.statistics) +
           audit(input) + omitted(input) + "\n" + closing_lines(kind, input.file);
}

}  // namespace peterka
