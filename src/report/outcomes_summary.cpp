#include "report/outcomes_summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <utility>
#include <vector>

#include "job/axis_quantity.hpp"
#include "job/rig_draws.hpp"
#include "report/regime_words.hpp"
#include "support/readable.hpp"

namespace peterka {
namespace {

using findings::OutcomeFindings;

// The commonest likely outcomes, with their shares of the plane.
std::string likely_ones(const OutcomeFindings& findings, const char* of_what) {
    using Entry = std::pair<findings::AttractorLabel, std::int64_t>;
    constexpr std::size_t shown = 6;
    std::vector<Entry> outcomes(findings.by_likely.begin(), findings.by_likely.end());
    if (outcomes.empty()) return "  no outcome has a probability of 95 % or more anywhere\n";
    std::ranges::stable_sort(outcomes, std::ranges::greater{}, &Entry::second);
    std::string text = "  with at least 95 % probability: ";
    for (std::size_t i = 0; i < std::min(shown, outcomes.size()); ++i) {
        const auto& [label, cells] = outcomes[i];
        text += fmt::format("{}{} in {}", i == 0 ? "" : ", ",
                            name_of({label.regime, {label.period, label.impacts}}),
                            readable_share(cells, findings.counts.cells));
        if (i == 0) text += of_what;
    }
    return text + (outcomes.size() > shown ? fmt::format(" and {} more\n", outcomes.size() - shown) : "\n");
}

}  // namespace

std::string drawn_again_in_words(const job::Job& job) {
    const job::RigDraws draws(job);
    if (draws.drawn_again() == 0) return "";
    return fmt::format(
        "{} drawn again, most of them since {} was out of its range",
        draws.drawn_again() == 1 ? "1 rig was" : readable_count(draws.drawn_again()) + " rigs were",
        job::key_in_tables(draws.most_out_of_range()));
}

std::string outcomes_summary(const job::Job& job, const OutcomeFindings& findings) {
    const findings::OutcomeCounts& counts = findings.counts;
    if (job.uncertainty.rigs == 0 || counts.cells == 0) return "";
    const bool is_sweep = job.kind == job::Kind::sweep;
    std::string text = fmt::format("\nWhat {} uncertain rigs do in each {}\n",
                                   readable_count(job.uncertainty.rigs), is_sweep ? "point" : "cell");
    text += likely_ones(findings, is_sweep ? " of the points" : " of the plane");
    text += fmt::format("  no outcome as likely: {}; {} than most of them: {}\n",
                        readable_share(counts.open, counts.cells),
                        is_sweep ? "a branch is on another one" : "the job's own rig ends otherwise",
                        readable_share(counts.other_own, counts.cells));
    if (counts.left_over > 0)
        text +=
            fmt::format("  {} {} have more outcomes than the {} that are kept\n",
                        readable_count(counts.left_over), is_sweep ? "points" : "cells", cell::kept_outcomes);
    const std::string again = drawn_again_in_words(job);
    return again.empty() ? text : text + fmt::format("  {}\n", again);
}

}  // namespace peterka
