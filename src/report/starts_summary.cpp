#include "report/summary_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "support/readable.hpp"

namespace peterka {
namespace {

using findings::AttractorLabel;
using findings::StartCounts;
using findings::StartFindings;

std::string attractor_in_words(const AttractorLabel& label) {
    using enum regime::Regime;
    switch (label.regime) {
        case no_impact:
            return "no impact";
        case periodic:
            return fmt::format("{}/{}", label.impacts, label.period);
        case chaotic:
            return "chaos";
        case sustained_contact:
            return "sustained contact";
        case unresolved:
            return "unresolved";
        case failed:
            break;
    }
    return "failed";
}

std::string numbers(const StartCounts& counts) {
    std::string text = "  attractors on which they end:";
    for (std::size_t n = 0; n < counts.by_number.size(); ++n) {
        if (counts.by_number[n] == 0) continue;
        text += fmt::format(
            "{} {}{}: {}", text.ends_with(':') ? "" : ",", n == 0 ? "none that is resolved" : std::to_string(n),
            n == StartCounts::told_apart ? " or more" : "", readable_share(counts.by_number[n], counts.cells));
    }
    return text + "\n";
}

// Cells may have more attractors than are stored.
std::string of_kept(const StartCounts& counts) {
    return counts.left_over > 0 ? ", of the attractors that are kept" : "";
}

// They are counted as no attractor, if they are kept.
std::string failing(const StartCounts& counts) {
    if (counts.failing == 0) return "";
    return fmt::format(
        "  besides, starts that leave physics or the range of numbers (failed){}: in {} of the cells,\n"
        "  up to {:.3g} % of a cell's starts\n",
        of_kept(counts), readable_share(counts.failing, counts.cells), 100 * counts.most_failing);
}

std::string commonest_pairs(const StartFindings& findings) {
    using Entry = std::pair<findings::AttractorPair, std::int64_t>;
    constexpr std::size_t shown = 5;
    std::vector<Entry> pairs(findings.pairs.begin(), findings.pairs.end());
    if (pairs.empty()) return "";
    std::ranges::stable_sort(pairs, std::ranges::greater{}, &Entry::second);
    std::string text = "  commonest pairs: ";
    for (std::size_t i = 0; i < std::min(shown, pairs.size()); ++i) {
        const auto& [pair, cells] = pairs[i];
        text += fmt::format("{}{} with {}{} {}", i == 0 ? "" : ", ", attractor_in_words(pair.upper),
                            pair.upper == pair.lower ? "another " : "", attractor_in_words(pair.lower),
                            readable_share(cells, findings.counts.cells));
    }
    return text + (pairs.size() > shown ? fmt::format(" and {} more\n", pairs.size() - shown) : "\n");
}

// Motions known besides those that starts found.
std::string what_is_known(const StartCounts& counts) {
    std::string text;
    const auto add = [&](std::int64_t cells, const char* what) {
        if (cells == 0) return;
        text += fmt::format("{} {} in {} {}", text.empty() ? "  known, though no start ended on it:" : ",",
                            what, readable_count(cells), cells == 1 ? "cell" : "cells");
    };
    add(counts.known_free, "a motion without impacts");
    add(counts.known_hit, "one with impacts");
    return text.empty() ? text : text + "\n";
}

// To so many digits, as a number: 390, where their format alone would say 3.9e+02.
double rounded(double number, int digits) {
    return std::stod(fmt::format("{:.{}e}", number, digits - 1));
}

std::string dying_chaos(const scene::Scene& scene, const StartCounts& counts) {
    if (!counts.shortest.found()) return "";
    const scene::Cell cell = scene.cell(counts.shortest.row, counts.shortest.column);
    const double cycle = cell.oscillator.period() / cell.scales.frequency_rad_per_s;
    return fmt::format(
        "  cells with chaos from which starts escape{}: {}; its mean life, where it is shortest: {:g} +- {:g} "
        "s, "
        "{:g} cycles\n",
        of_kept(counts), readable_count(counts.dying), rounded(counts.shortest.seconds, 2),
        rounded(counts.shortest.error, 1), rounded(counts.shortest.seconds / cycle, 2));
}

// An attractor with share s is missed by n starts with probability (1 - s)^n.
std::string what_is_missed(std::int64_t starts) {
    constexpr double even = 0.5;
    constexpr double hardly_ever = 0.01;
    const auto share_missed_with = [&](double probability) {
        return 100 * (1 - std::pow(probability, 1 / static_cast<double>(starts)));
    };
    return fmt::format(
        "  {} starts miss an attractor whose basin takes {:.2g} % of the rectangle in every second cell, one "
        "with\n"
        "  {:.2g} % in one cell of a hundred\n",
        readable_count(starts), share_missed_with(even), share_missed_with(hardly_ever));
}

}  // namespace

std::string starts_summary(const scene::Scene& scene, const StartFindings& findings) {
    const job::Job& job = scene.job();
    const StartCounts& counts = findings.counts;
    if (job.starts.count == 0 || counts.cells == 0) return "";
    std::string text = fmt::format("\nWhere {} starts of each cell end\n", readable_count(job.starts.count));
    text += numbers(counts) + failing(counts) + commonest_pairs(findings);
    text +=
        fmt::format("  motions with impacts and without{}: {} of the cells; none with impacts is known: {}\n",
                    of_kept(counts), readable_share(counts.mixed, counts.cells),
                    readable_share(counts.never_hit, counts.cells));
    text += what_is_known(counts);
    text += fmt::format("  {} another attractor than most starts in {} of the cells\n",
                        job.kind == job::Kind::sweep ? "a branch is on" : "[start] ends on",
                        readable_share(counts.minority, counts.cells));
    if (counts.not_kept > 0)
        text += fmt::format(
            "  among them those that end on none of the attractors that are kept: {} of the cells\n",
            readable_share(counts.not_kept, counts.cells));
    if (counts.left_over > 0)
        text += fmt::format(
            "  {} cells have more attractors than starts.attractors keeps; the others may be unresolved or "
            "failed\n",
            readable_count(counts.left_over));
    return text + dying_chaos(scene, counts) + what_is_missed(job.starts.count);
}

}  // namespace peterka
