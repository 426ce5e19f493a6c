#include "report/summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "job/axis.hpp"
#include "job/axis_quantity.hpp"
#include "job/names.hpp"
#include "regime/solve_cell.hpp"
#include "report/audit_summary.hpp"
#include "report/axis_words.hpp"
#include "report/starts_inside.hpp"
#include "report/starts_summary.hpp"
#include "report/sweep_summary.hpp"
#include "support/readable.hpp"

namespace peterka {
namespace {

using findings::LargestForce;
using findings::Statistics;
using regime::Regime;

std::string what_the_cells_are(const job::Job& job) {
    switch (job.kind) {
        case job::Kind::basin:
            return fmt::format("starts at Omega/omega {:g}, gap/A0 {:g}", job.operating_point.frequency_ratio,
                               job.operating_point.gap_ratio);
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

std::string regime_line(const Statistics& statistics, Regime regime, const char* name,
                        const std::string& meaning) {
    const std::int64_t cells = statistics.cells_of(regime);
    if (cells == 0) return "";
    return fmt::format("  {:<18}{:>14}{:>9}   {}\n", name, readable_count(cells),
                       readable_share(cells, statistics.counts.cells), meaning);
}

// What a cell without a regime ran into, or what a proof leaves open.
const char* in_words(regime::Status status) {
    using regime::Status;
    switch (status) {
        case Status::proved:
            return "proved";
        case Status::budget:
            return "no proof within steady_state.max_cycles";
        case Status::conservative:
            return "nothing dissipates, so nothing settles";
        case Status::too_many_events:
            return "too many contacts in one cycle";
        case Status::not_finite:
            return "numbers grew out of range";
        case Status::solver_failed:
            return "the integrator gave up";
        case Status::rounding:
            return "rounding decides the label; the last bit of the start turns it";
        case Status::imprecise:
            return "the peak force may be off by more than solver.tolerance";
        case Status::chaotic_so_far:
            return "chaotic for max_cycles, too few in this rig to tell chaos from a long transient";
    }
    return "";
}

// With the number of such cells.
std::string reasons(std::span<const std::int64_t> cells_by_status) {
    std::string text;
    for (std::size_t status = 0; status < cells_by_status.size(); ++status) {
        if (cells_by_status[status] == 0) continue;
        text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", readable_count(cells_by_status[status]),
                            in_words(static_cast<regime::Status>(status)));
    }
    return text;
}

std::string observed(const findings::Observed& chaos) {
    if (chaos.most == 0) return "filled from chaotic cells around";
    const std::string cycles = chaos.fewest == chaos.most
                                   ? readable_count(chaos.most)
                                   : readable_count(chaos.fewest) + " to " + readable_count(chaos.most);
    return fmt::format("chaotic for the {} cycles that were observed; it may settle later", cycles);
}

// What proofs leave open.
std::string open_ends(const findings::Counts& counts) {
    std::string text;
    for (std::size_t status = 1; status < counts.open_by_status.size();
         ++status) {  // but those that are proved
        if (counts.open_by_status[status] == 0) continue;
        text += fmt::format("  {} of these: {}\n", readable_count(counts.open_by_status[status]),
                            in_words(static_cast<regime::Status>(status)));
    }
    return text;
}

std::string regimes(const SummaryInput& input) {
    const Statistics& statistics = input.findings.statistics;
    return "\nWhat the hammer settles into\n" +
           regime_line(statistics, Regime::no_impact, "no impact", "it swings without reaching the stop") +
           regime_line(statistics, Regime::periodic, "periodic",
                       "z = p/q: p impacts in q forcing cycles, for ever") +
           regime_line(statistics, Regime::chaotic, "chaotic", observed(statistics.chaos)) +
           regime_line(statistics, Regime::sustained_contact, "sustained contact", "it stays on the stop") +
           regime_line(statistics, Regime::unresolved, "unresolved",
                       reasons(statistics.counts.unresolved_by_status)) +
           regime_line(statistics, Regime::failed, "failed", reasons(statistics.counts.failed_by_status)) +
           open_ends(statistics.counts);
}

std::string most_frequent_classes(const Statistics& statistics) {
    using Entry = std::pair<findings::ImpactClass, std::int64_t>;
    constexpr std::size_t shown = 6;
    std::vector<Entry> classes(statistics.periodic_cells.begin(), statistics.periodic_cells.end());
    if (classes.empty()) return "";
    std::ranges::stable_sort(classes, std::ranges::greater{}, &Entry::second);

    std::string text = "  most frequent z: ";
    for (std::size_t i = 0; i < std::min(shown, classes.size()); ++i) {
        const auto& [impact_class, cells] = classes[i];
        text += fmt::format("{}{}/{} {}", i == 0 ? "" : ", ", impact_class.impacts, impact_class.period,
                            readable_share(cells, statistics.counts.cells));
    }
    if (classes.size() > shown) text += fmt::format(" and {} more", classes.size() - shown);
    return text + "\n";
}

// How long impacts last that end, and who sees them in a run of so many cycles.
std::string transients(const SummaryInput& input) {
    const findings::Transients& ends = input.findings.statistics.transients;
    if (!input.scene.job().output.has(job::OptionalField::last_impact)) return "";
    if (ends.ended == 0) return "\nNo cell strikes the stop first and ends without impact.\n";
    const double mean = static_cast<double>(ends.cycles) / static_cast<double>(ends.ended);
    std::string text = fmt::format(
        "\nImpacts that end\n  {} end without impact after {:.4g} cycles with impacts on "
        "average, {} at most\n  still impacting after",
        ends.ended == 1 ? "1 cell" : readable_count(ends.ended) + " cells", mean, readable_count(ends.longest));
    const char* separator = " ";
    for (std::size_t n = 0; n < findings::Transients::looks.size(); ++n) {
        const std::int64_t look = findings::Transients::looks[n];
        if (look >= input.scene.job().steady_state.max_cycles) break;
        text += fmt::format("{}{} cycles: {}", separator, readable_count(look),
                            readable_share(ends.impacting[n], ends.cells));
        separator = ", ";
    }
    return text + "\n";
}

// A largest value at the border of what was looked at may go on growing beyond.
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

// An orbit has one force, whatever start leads to it.
std::string place_in_basin(const SummaryInput& input, const LargestForce& force) {
    const job::Job& job = input.scene.job();
    const findings::Extremes& largest = input.findings.statistics.largest;
    const bool is_orbit = force.peak_force_ratio == largest.periodic.peak_force_ratio;
    if (is_orbit) return "on an orbit: the same from every start that leads to it";
    return fmt::format("without a period, from x/A0 {:.4g}, x'/(A0 omega) {:.4g}",
                       job::axis_value(job.columns, force.column), job::axis_value(job.rows, force.row));
}

std::string place(const SummaryInput& input, const LargestForce& force) {
    const job::Job& job = input.scene.job();
    if (job.kind == job::Kind::basin) return place_in_basin(input, force);
    return fmt::format("at {}{}", place_in_words(input.scene, force.row, force.column), border(job, force));
}

std::string force_line(const SummaryInput& input, const char* of, const LargestForce& force) {
    if (!force.found() || !(force.peak_force_ratio > 0)) return "";
    const double weight = input.scene.cell(force.row, force.column).scales.weight_n;
    return fmt::format("  {:<12}{:>6.4g} weights = {:>8}   {}\n", of, force.peak_force_ratio,
                       readable_amount(force.peak_force_ratio * weight, "N"), place(input, force));
}

bool strikes(const Statistics& statistics) {
    return statistics.cells_of(Regime::periodic) + statistics.cells_of(Regime::chaotic) +
               statistics.cells_of(Regime::unresolved) >
           0;
}

std::string forces(const SummaryInput& input) {
    const auto& largest = input.findings.statistics.largest;
    if (job::is_rigid(input.scene.job().contact) && strikes(input.findings.statistics)) {
        return "\nNo peak forces: a rigid stop strikes with forces beyond any bound. Ask for impact_speed or "
               "impulse\n"
               "under [output] fields instead.\n";
    }
    const std::string lines =
        force_line(input, "of all", largest.any_regime) + force_line(input, "of z = 1/1", largest.one_to_one);
    if (lines.empty()) return "\nNo cell strikes the stop for ever.\n";
    const auto is_mass = [](std::string_view key) { return key == "hammer.mass_kg"; };
    const std::string weight =
        has_axis(input.scene.job(), is_mass)
            ? std::string("over the weight that the hammer has there")
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
        "\nWork\n{}  {:.1f} forcing cycles and {} per cell, {} of computing in all\n"
        "  this run: {} on {} {}\n",
        refinement(statistics), static_cast<double>(statistics.counts.cycles) / cells,
        readable_duration(statistics.tile_seconds / cells), readable_duration(statistics.tile_seconds),
        readable_duration(input.effort.wall_seconds), input.effort.ranks,
        input.effort.ranks == 1 ? "rank" : "ranks");
}

std::string audit(const SummaryInput& input) {
    if (!input.findings.audit) return "";
    const auto cells = static_cast<double>(std::max<std::int64_t>(input.findings.statistics.counts.cells, 1));
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
    const std::string file = input.file.string();
    const char* kind = input.scene.job().kind == job::Kind::sweep ? "Sweep file" : "Map file";
    return heading(input) + starts(input) + regimes(input) + most_frequent_classes(input.findings.statistics) +
           starts_summary(input.scene.job(), input.findings.statistics.starts) + transients(input) +
           forces(input) + sweep_text(input.scene, input.findings.branches) + effort(input) + audit(input) +
           omitted(input) +
           fmt::format("\n{:<11}{}\n{:<11}postprocess/draw.py {}\n", kind, file, "Draw it", shell_word(file));
}

}  // namespace peterka
